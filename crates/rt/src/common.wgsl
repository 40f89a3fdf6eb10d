// What the shaders that trace have in common; it stands before each of them.
enable wgpu_ray_query;

const FORCE_OPAQUE = 0x01u;
const FORCE_NO_OPAQUE = 0x02u;
// So that every positive t counts, and none is infinite.
const FAR = 3.0e38;

// Numbers at random, by PCG's generator and a mixing function.
var<private> state: u32;

fn mixed(value: u32) -> u32 {
    var x = value;
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

fn draw() -> u32 {
    state = state * 747796405u + 2891336453u;
    return mixed(state);
}

