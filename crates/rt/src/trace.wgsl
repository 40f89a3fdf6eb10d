// One ray an invocation: the nearest hit, and all that the ray meets.

struct Ray { origin: vec3f, t_min: f32, direction: vec3f, t_max: f32 }
struct Found { is_hit: u32, face: u32, t: f32, u: f32, v: f32, count: u32 }
struct Met { face: u32, t: f32 }
// How many rays there are, and how many of what each meets is written.
struct Sizes { rays: u32, room: u32 }

@group(0) @binding(0) var scene: acceleration_structure;
@group(0) @binding(1) var<storage, read> sizes: Sizes;
@group(0) @binding(2) var<storage, read> rays: array<Ray>;
@group(0) @binding(3) var<storage, read_write> found: array<Found>;
@group(0) @binding(4) var<storage, read_write> met: array<Met>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x;
    if i >= sizes.rays { return; }
    let ray = rays[i];

    var nearest: ray_query;
    rayQueryInitialize(&nearest, scene, RayDesc(FORCE_OPAQUE, 0xffu, ray.t_min, ray.t_max, ray.origin, ray.direction));
    while rayQueryProceed(&nearest) {}
    let hit = rayQueryGetCommittedIntersection(&nearest);
    if hit.kind == RAY_QUERY_INTERSECTION_TRIANGLE {
        found[i] = Found(1u, hit.primitive_index, hit.t, hit.barycentrics.x, hit.barycentrics.y, 0u);
    } else {
        found[i] = Found(0u, 0u, 0.0, 0.0, 0.0, 0u);
    }

    // No candidate is confirmed, so the ray goes on behind each.
    var all: ray_query;
    var count = 0u;
    rayQueryInitialize(&all, scene, RayDesc(FORCE_NO_OPAQUE, 0xffu, ray.t_min, ray.t_max, ray.origin, ray.direction));
    while rayQueryProceed(&all) {
        let candidate = rayQueryGetCandidateIntersection(&all);
        if candidate.kind == RAY_QUERY_INTERSECTION_TRIANGLE {
            if count < sizes.room {
                met[i * sizes.room + count] = Met(candidate.primitive_index, candidate.t);
            }
            count += 1u;
        }
    }
    found[i].count = count;
}
