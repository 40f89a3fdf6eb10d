
// Rays at the vertices, edges or faces of a closed mesh, from inside, or through them from outside: each has to meet the mesh.

// Rays from outside start at a distance, those from inside have none.
struct Task { seed: u32, rays: u32, faces: u32, aim: u32, room: u32, distance: f32 }
struct Suspect { ox: f32, oy: f32, oz: f32, dx: f32, dy: f32, dz: f32, is_hit: u32 }
struct Counters { lost: atomic<u32>, even: atomic<u32> }

@group(0) @binding(3) var<storage, read> task: Task;
@group(0) @binding(4) var<storage, read_write> counters: Counters;
@group(0) @binding(5) var<storage, read_write> suspects: array<Suspect>;

const AT_VERTEX = 0u;
const AT_EDGE = 1u;

fn target_point() -> vec3f {
    let face = draw() % task.faces;
    let first = draw() % 3u;
    let a = corner(face, first);
    let b = corner(face, first + 1u);
    let c = corner(face, first + 2u);
    if task.aim == AT_VERTEX { return a; }
    var s = unit();
    if task.aim == AT_EDGE {
        // A quarter of them at the middle, and a quarter near a vertex.
        let kind = draw() % 4u;
        if kind == 0u { s = 0.5; }
        if kind == 1u { s = s * s * s * s * s * s; }
        return a + s * (b - a);
    }
    var r = unit();
    if s + r > 1.0 { s = 1.0 - s; r = 1.0 - r; }
    return a + s * (b - a) + r * (c - a);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= task.rays { return; }
    begin(id.x, task.seed);
    let inside = point_inside();
    let to_target = target_point() - inside;
    let largest = max(max(abs(to_target.x), abs(to_target.y)), abs(to_target.z));
    if largest == 0.0 { return; }
    var origin = inside;
    var direction = to_target;
    var last = FAR;
    if task.distance > 0.0 {
        // So scaled, squares of it are in range at every size.
        origin = inside + task.distance * normalize(to_target / largest);
        direction = inside - origin;
        // Only as far as the point inside: what lies behind it would hide a loss.
        last = 1.0;
    }

    var nearest: ray_query;
    rayQueryInitialize(&nearest, scene, RayDesc(FORCE_OPAQUE, 0xffu, 0.0, last, origin, direction));
    while rayQueryProceed(&nearest) {}
    let is_hit = rayQueryGetCommittedIntersection(&nearest).kind != RAY_QUERY_INTERSECTION_NONE;

    var all_hits: ray_query;
    var count = 0u;
    rayQueryInitialize(&all_hits, scene, RayDesc(FORCE_NO_OPAQUE, 0xffu, 0.0, last, origin, direction));
    while rayQueryProceed(&all_hits) {
        let kind = rayQueryGetCandidateIntersection(&all_hits).kind;
        if kind == RAY_QUERY_INTERSECTION_TRIANGLE { count += 1u; }
    }

    // The first half of the room is for lost rays, the second for those with an even count.
    let suspect = Suspect(origin.x, origin.y, origin.z, direction.x, direction.y, direction.z, u32(is_hit));
    if !is_hit {
        let place = atomicAdd(&counters.lost, 1u);
        if place < task.room { suspects[place] = suspect; }
    } else if task.distance == 0.0 && count % 2u == 0u {
        let place = atomicAdd(&counters.even, 1u);
        if place < task.room { suspects[task.room + place] = suspect; }
    }
}
