@group(0) @binding(0) var<storage, read> count: u32;
@group(0) @binding(1) var<storage, read> numbers: array<f32>;
@group(0) @binding(2) var<storage, read_write> results: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x;
    if i >= count { return; }
    let a = numbers[8u * i]; let b = numbers[8u * i + 1u]; let c = numbers[8u * i + 2u]; let d = numbers[8u * i + 3u];
    let e = numbers[8u * i + 4u]; let f = numbers[8u * i + 5u]; let g = numbers[8u * i + 6u]; let h = numbers[8u * i + 7u];
    let x = vec3f(a, b, c); let y = vec3f(d, e, f); let z = vec3f(g, h, a);
    results[i] = EXPRESSION;
}
