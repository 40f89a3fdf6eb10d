// Möller and Trumbore's test (1997, the branch without culling), one case an invocation.
// The records are those of docs/protocol.md: 17 numbers a case, 5 words a verdict.

struct Batch {
    count: u32,
    parallel: f32,
}

@group(0) @binding(0) var<storage, read> batch: Batch;
@group(0) @binding(1) var<storage, read> cases: array<f32>;
@group(0) @binding(2) var<storage, read> factors: array<f32>;
@group(0) @binding(3) var<storage, read_write> verdicts: array<u32>;

fn vector(at: u32) -> vec3<f32> {
    return vec3<f32>(cases[at], cases[at + 1u], cases[at + 2u]);
}

// The verdict's five words.
fn test(origin: vec3<f32>, direction: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> array<u32, 5> {
    let miss = array<u32, 5>(0u, 0u, 0u, 0u, 0u);
    let edge1 = b - a;
    let edge2 = c - a;
    let p = cross(direction, edge2);
    let det = dot(edge1, p);
    if (abs(det) < batch.parallel) {
        return miss;
    }
    let inverse = 1.0 / det;
    let s = origin - a;
    let u = dot(s, p) * inverse;
    if (u < 0.0 || u > 1.0) {
        return miss;
    }
    let q = cross(s, edge1);
    let v = dot(direction, q) * inverse;
    if (v < 0.0 || u + v > 1.0) {
        return miss;
    }
    let t = dot(edge2, q) * inverse;
    return array<u32, 5>(1u, select(2u, 1u, det > 0.0), bitcast<u32>(t), bitcast<u32>(u), bitcast<u32>(v));
}

// The factor is 1, unless products or sums are asked for (inputs.rs).
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= batch.count) {
        return;
    }
    let at = 17u * id.x;
    let factor = factors[id.x];
    let origin = vector(at);
    let direction = vector(at + 3u);
    let a = vector(at + 6u);
    let b = vector(at + 9u);
    let c = vector(at + 12u);
    var verdict: array<u32, 5>;
    if (factor < 0.0) {
        verdict = test(origin, direction, a, a + b, a + c);
    } else {
        verdict = test(origin * factor, direction * factor, a * factor, b * factor, c * factor);
    }
    for (var i = 0u; i < 5u; i++) {
        verdicts[5u * id.x + i] = verdict[i];
    }
}
