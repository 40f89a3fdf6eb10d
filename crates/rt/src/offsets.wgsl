
// First rays from points inside a closed mesh, and second rays from where they hit: does the surface that they leave stop them?

struct Task { seed: u32, rays: u32, scheme: u32, value: f32, is_along_ray: u32 }
struct Counters { rays: atomic<u32>, self_hits: atomic<u32>, lost: atomic<u32> }

@group(0) @binding(3) var<storage, read> task: Task;
@group(0) @binding(4) var<storage, read_write> counters: Counters;

// Second rays are no flatter than this, as the cosine of their angle with the normal.
const FLATTEST = 1.0e-3;

const NONE = 0u;
const NORMAL = 1u;
const ULPS = 2u;
const WAECHTER_BINDER = 3u;
const T_MIN = 4u;

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

// A vector whose largest component is 1.
fn of_size_1(v: vec3f) -> vec3f {
    return v / max(max(abs(v.x), abs(v.y)), abs(v.z));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= task.rays { return; }
    begin(id.x, task.seed);
    let origin = point_inside();
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
    var n = normalize(cross(of_size_1(b - a), of_size_1(c - a)));
    if dot(n, first_direction) > 0.0 { n = -n; }
    var second_direction = direction();
    if dot(second_direction, n) < 0.0 { second_direction = -second_direction; }
    let start = start_of(p, n);
    // Neither is true of a normal or a start that is no number.
    if !(dot(second_direction, n) >= FLATTEST) || !all(abs(start) < vec3f(FAR)) { return; }
    let t_min = select(0.0, task.value, task.scheme == T_MIN);

    var second: ray_query;
    rayQueryInitialize(&second, scene, RayDesc(FORCE_OPAQUE, 0xffu, t_min, FAR, start, second_direction));
    while rayQueryProceed(&second) {}
    let next = rayQueryGetCommittedIntersection(&second);
    atomicAdd(&counters.rays, 1u);
    if next.kind == RAY_QUERY_INTERSECTION_NONE {
        atomicAdd(&counters.lost, 1u);
    } else if next.primitive_index == hit.primitive_index {
        atomicAdd(&counters.self_hits, 1u);
    }
}
