// What the shaders that trace have in common; it stands before each of them.
enable wgpu_ray_query;

const FORCE_OPAQUE = 0x01u;
const FORCE_NO_OPAQUE = 0x02u;
// So that every positive t counts, and none is infinite.
const FAR = 3.0e38;
