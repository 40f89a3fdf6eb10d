//! The code of the pages in findings/, which `cargo test --doc` compiles and runs as it stands there.

macro_rules! pages {
    ($($module:ident $page:literal),* $(,)?) => {
        $(#[doc = include_str!(concat!("../findings/", $page))] mod $module {})*
    };
}

pages!(
    brepkit_math "brepkit-math.md",
    bvh "bvh.md",
    fyrox_math "fyrox-math.md",
    manifold_rust "manifold-rust.md",
    mesh_geometry "mesh-geometry.md",
    obvhs "obvhs.md",
    obvhs_embree "obvhs-embree.md",
    parry3d "parry3d.md",
    rayx "rayx.md",
    rustsim_geometry "rustsim-geometry.md",
    tri_mesh "tri-mesh.md",
    vek "vek.md",
);
