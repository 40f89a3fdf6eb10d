#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Count { uint count; };
layout(std430, binding = 1) readonly buffer Numbers { float numbers[]; };
layout(std430, binding = 2) buffer Results { float results[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    float a = numbers[8u * i], b = numbers[8u * i + 1u], c = numbers[8u * i + 2u], d = numbers[8u * i + 3u];
    float e = numbers[8u * i + 4u], f = numbers[8u * i + 5u], g = numbers[8u * i + 6u], h = numbers[8u * i + 7u];
    vec3 x = vec3(a, b, c), y = vec3(d, e, f), z = vec3(g, h, a);
    precise float result = EXPRESSION;
    results[i] = result;
}
