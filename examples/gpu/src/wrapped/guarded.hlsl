
struct Batch { uint count; float parallel; };
[[vk::binding(0, 0)]] StructuredBuffer<Batch> batch;
[[vk::binding(1, 0)]] StructuredBuffer<float> cases;
[[vk::binding(2, 0)]] StructuredBuffer<float> factors;
[[vk::binding(3, 0)]] RWStructuredBuffer<uint> verdicts;

float3 vector_at(uint at) {
    return float3(cases[at], cases[at + 1], cases[at + 2]);
}

// What the kernel is asked about are the rounded products and sums.
[numthreads(64, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint id = thread.x;
    if (id >= batch[0].count) { return; }
    uint at = 17 * id;
    float factor = factors[id];
    float3 o = vector_at(at);
    float3 d = vector_at(at + 3);
    float3 a = vector_at(at + 6);
    float3 b = vector_at(at + 9);
    float3 c = vector_at(at + 12);
    float3 values;
    int answer;
    if (factor < 0) {
        answer = KERNEL(o, d, a, a + b, a + cENDS, values);
    } else {
        answer = KERNEL(o * factor, d * factor, a * factor, b * factor, c * factorENDS, values);
    }
    for (uint i = 0; i < 5; i++) { verdicts[5 * id + i] = 0; }
    if (answer == HAIRLINE_HIT || answer == COUNTED) { verdicts[5 * id] = 1; }
}
