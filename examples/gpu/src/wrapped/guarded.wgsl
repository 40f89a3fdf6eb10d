
struct Batch { count: u32, parallel: f32, zero: u32 }
@group(0) @binding(0) var<storage, read> batch: Batch;
@group(0) @binding(1) var<storage, read> cases: array<f32>;
@group(0) @binding(2) var<storage, read> factors: array<f32>;
@group(0) @binding(3) var<storage, read_write> verdicts: array<u32>;

fn vector(at: u32) -> vec3f {
    return vec3f(cases[at], cases[at + 1u], cases[at + 2u]);
}

// What the kernel is asked about are the rounded products and sums.
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= batch.count) { return; }
    let at = 17u * id.x;
    let factor = factors[id.x];
    let o = vector(at);
    let d = vector(at + 3u);
    let a = vector(at + 6u);
    let b = vector(at + 9u);
    let c = vector(at + 12u);
    var values: vec3f;
    var answer = HAIRLINE_MISS;
    if (factor < 0.0) {
        answer = KERNEL(o, d, a, a + b, a + cENDS, batch.zero, &values);
    } else {
        answer = KERNEL(o * factor, d * factor, a * factor, b * factor, c * factorENDS, batch.zero, &values);
    }
    for (var i = 0u; i < 5u; i++) { verdicts[5u * id.x + i] = 0u; }
    if (answer == HAIRLINE_HIT || answer == COUNTED) { verdicts[5u * id.x] = 1u; }
}
