
// Points inside a closed mesh, at random; it stands before the shaders that make rays of them.

// A ball inside the mesh: its middle and its radius.
struct Ball { x: f32, y: f32, z: f32, radius: f32 }

@group(0) @binding(0) var scene: acceleration_structure;
@group(0) @binding(1) var<storage, read> balls: array<Ball>;
@group(0) @binding(2) var<storage, read> corners: array<f32>;

// Two words that say which ray this is, and how many numbers it drew.
var<private> key: vec2u;
var<private> drawn: u32;

fn mixed(value: u32) -> u32 {
    var x = value;
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

fn begin(ray: u32, seed: u32) {
    key = vec2u(mixed(ray), mixed(seed ^ 0x9e3779b9u));
    drawn = 0u;
}

fn draw() -> u32 {
    drawn += 1u;
    return mixed(mixed(key.x + drawn * 0x9e3779b9u) ^ (key.y + drawn));
}

fn unit() -> f32 { return f32(draw() >> 8u) / 16777216.0; }

fn symmetric() -> f32 { return 2.0 * unit() - 1.0; }

// A vector at most 1 long. The loop gives up after a while, so that it ends on every device.
fn in_unit_ball() -> vec3f {
    for (var i = 0; i < 32; i++) {
        let v = vec3f(symmetric(), symmetric(), symmetric());
        if dot(v, v) <= 1.0 { return v; }
    }
    return vec3f(0.0);
}

// A direction of length 1.
fn direction() -> vec3f {
    for (var i = 0; i < 32; i++) {
        let v = in_unit_ball();
        if dot(v, v) > 0.01 { return normalize(v); }
    }
    return vec3f(1.0, 0.0, 0.0);
}

fn point_inside() -> vec3f {
    let ball = balls[draw() % arrayLength(&balls)];
    return vec3f(ball.x, ball.y, ball.z) + ball.radius * in_unit_ball();
}

fn corner(face: u32, which: u32) -> vec3f {
    let first = 9u * face + 3u * (which % 3u);
    return vec3f(corners[first], corners[first + 1u], corners[first + 2u]);
}
