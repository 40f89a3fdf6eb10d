//! Epsilons in the field: what published libraries use, by gate and form.

use super::{Dimension, Gate, Tunable};

/// The epsilons of a library. A kernel takes each at a gate of the same name and dimension; one that lacks such a gate
/// is not the library's test, and does not take the others either.
pub struct Preset {
    /// The name on the command line.
    pub name: &'static str,
    /// Where the values come from.
    pub source: &'static str,
    /// One entry a gate.
    pub entries: &'static [PresetEntry],
}

/// One gate's epsilon in a preset.
pub struct PresetEntry {
    /// The gate's name.
    pub gate: &'static str,
    /// The dimension of what the library compares.
    pub dimension: Dimension,
    /// The comparison in the library's notation.
    pub form: &'static str,
    /// The epsilon, as in an [`EpsilonSet`](super::EpsilonSet).
    pub value: &'static str,
}

impl PresetEntry {
    /// True if a kernel's gate can take this epsilon.
    pub fn fits(&self, gate: &Gate) -> bool {
        gate.name == self.gate && gate.dimension == self.dimension && gate.epsilon != Tunable::Fixed
    }
}

impl Preset {
    /// By gate of a kernel its epsilon, where the preset has one; an error if an epsilon fits none of the gates.
    pub fn over<'a>(
        &'a self,
        gates: &'a [Gate],
    ) -> Result<impl Iterator<Item = Option<&'a PresetEntry>>, &'a PresetEntry> {
        match self
            .entries
            .iter()
            .find(|entry| !gates.iter().any(|gate| entry.fits(gate)))
        {
            Some(left_over) => Err(left_over),
            None => Ok(gates
                .iter()
                .map(|gate| self.entries.iter().find(|entry| entry.fits(gate)))),
        }
    }
}

const fn parallel(form: &'static str, value: &'static str) -> PresetEntry {
    PresetEntry {
        gate: "parallel",
        dimension: Dimension::new(2, 1),
        form,
        value,
    }
}

const fn t(form: &'static str, value: &'static str) -> PresetEntry {
    PresetEntry {
        gate: "t",
        dimension: Dimension::new(1, -1),
        form,
        value,
    }
}

/// One row per library.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "zero",
        source: "every gate at 0",
        entries: &[],
    },
    Preset {
        name: "bvh",
        source: "Rust crate bvh 0.13.0: det < EPSILON (absolute, culls), t <= EPSILON",
        entries: &[
            parallel("det < EPSILON", "EPSILON"),
            t("t <= EPSILON", "EPSILON"),
        ],
    },
    Preset {
        name: "bevy",
        source: "Bevy's mesh picking: abs(det) < f32::EPSILON",
        entries: &[parallel("abs(det) < EPSILON", "EPSILON")],
    },
    Preset {
        name: "fcpw",
        source: "fcpw: abs(det) <= FLT_EPSILON",
        entries: &[parallel("abs(det) <= EPSILON", "EPSILON")],
    },
    Preset {
        name: "jolt",
        source: "Jolt Physics: abs(det) < 1e-12",
        entries: &[parallel("abs(det) < e", "1e-12")],
    },
    Preset {
        name: "bullet",
        source: "Bullet: edge tolerance -1e-4 * |n|^2, of the edge function with n",
        entries: &[PresetEntry {
            gate: "edge-over-n2",
            dimension: Dimension::new(0, 0),
            form: "edge < -1e-4 * |n|^2",
            value: "-1e-4",
        }],
    },
    Preset {
        name: "godot",
        source: "Godot, Geometry3D::ray_intersects_triangle: abs(det) < 1e-5, t > 1e-5",
        entries: &[parallel("abs(det) < e", "1e-5"), t("!(t > e)", "1e-5")],
    },
    Preset {
        name: "three-mesh-bvh",
        source: "three-mesh-bvh's GLSL: abs(det) < 1e-5",
        entries: &[parallel("abs(det) < e", "1e-5")],
    },
    Preset {
        name: "rayx",
        source: "rayx: abs(det) < 16 * EPSILON",
        entries: &[parallel("abs(det) < 16*EPSILON", "16*EPSILON")],
    },
    Preset {
        name: "manifold-rust",
        source: "manifold-rust (f64): 1e-9 on det and t",
        entries: &[parallel("abs(det) < e", "1e-9"), t("t < e", "1e-9")],
    },
    Preset {
        name: "truck",
        source: "truck (f64): 1e-6 on det",
        entries: &[parallel("abs(det) < e", "1e-6")],
    },
    Preset {
        name: "trimesh",
        source: "trimesh: distance > -1e-6",
        entries: &[t("!(distance > e)", "-1e-6")],
    },
];
