
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Batch { uint count; float parallel; };
layout(std430, set = 0, binding = 1) readonly buffer Cases { float cases[]; };
layout(std430, set = 0, binding = 2) readonly buffer Factors { float factors[]; };
layout(std430, set = 0, binding = 3) buffer Verdicts { uint verdicts[]; };

vec3 vector(uint at) {
    return vec3(cases[at], cases[at + 1u], cases[at + 2u]);
}

// What the kernel is asked about are the rounded products and sums.
void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= count) { return; }
    uint at = 17u * id;
    float factor = factors[id];
    vec3 o = vector(at);
    vec3 d = vector(at + 3u);
    vec3 a = vector(at + 6u);
    vec3 b = vector(at + 9u);
    vec3 c = vector(at + 12u);
    vec3 values;
    int answer;
    if (factor < 0.0) {
        answer = KERNEL(o, d, a, a + b, a + cENDS, values);
    } else {
        answer = KERNEL(o * factor, d * factor, a * factor, b * factor, c * factorENDS, values);
    }
    for (uint i = 0u; i < 5u; i++) { verdicts[5u * id + i] = 0u; }
    if (answer == HAIRLINE_HIT || answer == COUNTED) { verdicts[5u * id] = 1u; }
}
