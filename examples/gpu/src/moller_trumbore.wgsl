// Möller and Trumbore's test (1997, the branch without culling), one case an invocation.
// The records are those of docs/protocol.md: 17 numbers a case, 5 words a verdict.

struct Batch {
    count: u32,
    parallel: f32,
}

@group(0) @binding(0) var<storage, read> batch: Batch;
@group(0) @binding(1) var<storage, read> cases: array<f32>;
@group(0) @binding(2) var<storage, read_write> verdicts: array<u32>;

fn vector(at: u32) -> vec3<f32> {
    return vec3<f32>(cases[at], cases[at + 1u], cases[at + 2u]);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= batch.count) {
        return;
    }
    let place = 5u * id.x;
    verdicts[place] = 0u;

    let at = 17u * id.x;
    let origin = vector(at);
    let direction = vector(at + 3u);
    let a = vector(at + 6u);
    let edge1 = vector(at + 9u) - a;
    let edge2 = vector(at + 12u) - a;
    let p = cross(direction, edge2);
    let det = dot(edge1, p);
    if (abs(det) < batch.parallel) {
        return;
    }
    let inverse = 1.0 / det;
    let s = origin - a;
    let u = dot(s, p) * inverse;
    if (u < 0.0 || u > 1.0) {
        return;
    }
    let q = cross(s, edge1);
    let v = dot(direction, q) * inverse;
    if (v < 0.0 || u + v > 1.0) {
        return;
    }
    verdicts[place] = 1u;
    verdicts[place + 1u] = select(2u, 1u, det > 0.0);
    verdicts[place + 2u] = bitcast<u32>(dot(edge2, q) * inverse);
    verdicts[place + 3u] = bitcast<u32>(u);
    verdicts[place + 4u] = bitcast<u32>(v);
}
