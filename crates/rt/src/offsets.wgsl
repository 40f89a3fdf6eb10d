// First rays from points inside a closed mesh, and second rays from where they hit: does the surface that they leave stop them?

struct Task { seed: u32, rays: u32, origins: u32, scheme: u32, value: f32, is_along_ray: u32 }
struct Counters { rays: atomic<u32>, self_hits: atomic<u32>, lost: atomic<u32> }

@group(0) @binding(0) var scene: acceleration_structure;
@group(0) @binding(1) var<storage, read> task: Task;
@group(0) @binding(2) var<storage, read> origins: array<f32>;
@group(0) @binding(3) var<storage, read> corners: array<f32>;
@group(0) @binding(4) var<storage, read_write> counters: Counters;

// Second rays are no flatter than this, as the cosine of their angle with the normal.
const FLATTEST = 1.0e-3;

const NONE = 0u;
const NORMAL = 1u;
const ULPS = 2u;
const WAECHTER_BINDER = 3u;
const T_MIN = 4u;

fn symmetric() -> f32 { return f32(draw() >> 8u) / 8388608.0 - 1.0; }

// A direction of length 1; the loop gives up after a while, so that it ends on every device.
fn direction() -> vec3f {
    var d = vec3f(1.0, 0.0, 0.0);
    for (var i = 0; i < 32; i++) {
        let candidate = vec3f(symmetric(), symmetric(), symmetric());
        let square = dot(candidate, candidate);
        if square <= 1.0 && square > 0.01 { d = candidate; break; }
    }
    return normalize(d);
}

fn corner(face: u32, which: u32) -> vec3f {
    let first = 9u * face + 3u * which;
    return vec3f(corners[first], corners[first + 1u], corners[first + 2u]);
}

// Wächter and Binder, Ray Tracing Gems, chapter 6.
fn by_integers(p: f32, n: f32) -> f32 {
    let steps = i32(256.0 * n);
    let moved = bitcast<f32>(bitcast<i32>(p) + select(steps, -steps, p < 0.0));
    return select(moved, p + n / 65536.0, abs(p) < 1.0 / 32.0);
}

fn start_of(p: vec3f, n: vec3f) -> vec3f {
    switch task.scheme {
        case NORMAL: { return p + n * task.value; }
        case ULPS: {
            let largest = max(max(abs(p.x), abs(p.y)), abs(p.z));
            let ulp = bitcast<f32>(bitcast<u32>(largest) + 1u) - largest;
            return p + n * (task.value * ulp);
        }
        case WAECHTER_BINDER: {
            return vec3f(by_integers(p.x, n.x), by_integers(p.y, n.y), by_integers(p.z, n.z));
        }
        default: { return p; }
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= task.rays { return; }
    state = mixed(mixed(id.x) ^ task.seed);
    let from_point = draw() % task.origins;
    let origin = vec3f(origins[3u * from_point], origins[3u * from_point + 1u], origins[3u * from_point + 2u]);
    let first_direction = direction();

    var first: ray_query;
    rayQueryInitialize(&first, scene, RayDesc(FORCE_OPAQUE, 0xffu, 0.0, FAR, origin, first_direction));
    while rayQueryProceed(&first) {}
    let hit = rayQueryGetCommittedIntersection(&first);
    if hit.kind == RAY_QUERY_INTERSECTION_NONE { return; }

    let a = corner(hit.primitive_index, 0u);
    let b = corner(hit.primitive_index, 1u);
    let c = corner(hit.primitive_index, 2u);
    let u = hit.barycentrics.x;
    let v = hit.barycentrics.y;
    var p = (1.0 - u - v) * a + u * b + v * c;
    if task.is_along_ray != 0u { p = origin + hit.t * first_direction; }
    var n = normalize(cross(b - a, c - a));
    if dot(n, first_direction) > 0.0 { n = -n; }
    var second_direction = direction();
    if dot(second_direction, n) < 0.0 { second_direction = -second_direction; }
    if dot(second_direction, n) < FLATTEST { return; }
    let t_min = select(0.0, task.value, task.scheme == T_MIN);

    var second: ray_query;
    rayQueryInitialize(&second, scene, RayDesc(FORCE_OPAQUE, 0xffu, t_min, FAR, start_of(p, n), second_direction));
    while rayQueryProceed(&second) {}
    let next = rayQueryGetCommittedIntersection(&second);
    atomicAdd(&counters.rays, 1u);
    if next.kind == RAY_QUERY_INTERSECTION_NONE {
        atomicAdd(&counters.lost, 1u);
    } else if next.primitive_index == hit.primitive_index {
        atomicAdd(&counters.self_hits, 1u);
    }
}
