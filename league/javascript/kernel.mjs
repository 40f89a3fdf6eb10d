// Ray-triangle tests of npm as kernels for hairline (docs/protocol.md): `node kernel.mjs NAME`.
// Each is a function of a case's vectors, as arrays of three, that says whether the triangle is hit.
import { createInterface } from "node:readline";

const PROMISE = "extent=ray,sides=both,boundary=free,ends=free,coplanar=free,degenerate=free";
// Positions in a Float32Array: the cases of f32 alone arrive as they are.
const kernels = {
    // A comment in its source: "the ray can never fall between" two triangles that share an edge.
    "three-js": async () => {
        const { Ray, REVISION, Vector3 } = await import("three");
        const hit = (o, d, ...triangle) => {
            const ray = new Ray(new Vector3(...o), new Vector3(...d));
            const [a, b, c] = triangle.map((p) => new Vector3(...p));
            return ray.intersectTriangle(a, b, c, false, new Vector3()) !== null;
        };
        return { hit, version: REVISION, contract: `${PROMISE},direction=unit:4,across=at-least-one` };
    },
    "three-mesh-bvh": async () => {
        const { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } = await import("three");
        const { MeshBVH } = await import("three-mesh-bvh");
        const hit = (o, d, a, b, c) => {
            const geometry = new BufferGeometry();
            const positions = new Float32Array([...a, ...b, ...c]);
            geometry.setAttribute("position", new BufferAttribute(positions, 3));
            const ray = new Ray(new Vector3(...o), new Vector3(...d));
            return Boolean(new MeshBVH(geometry).raycastFirst(ray, DoubleSide));
        };
        return { hit, scalar: "f32", contract: `${PROMISE},direction=unit:4` };
    },
    babylon: async () => {
        const { Ray } = await import("@babylonjs/core/Culling/ray.core.js");
        const { Vector3 } = await import("@babylonjs/core/Maths/math.vector.js");
        const hit = (o, d, ...triangle) => {
            const [a, b, c] = triangle.map((p) => new Vector3(...p));
            return new Ray(new Vector3(...o), new Vector3(...d)).intersectsTriangle(a, b, c) !== null;
        };
        // The ray's documented epsilon, 0.001, is a tolerance in weights: at a corner twice that of an edge.
        return { hit, contract: `${PROMISE},band=2e-3` };
    },
    cesium: async () => {
        const { Cartesian3, IntersectionTests, Ray } = await import("@cesium/engine");
        const ray = new Ray();
        const hit = (o, d, ...triangle) => {
            const [a, b, c] = triangle.map((p) => new Cartesian3(...p));
            ray.origin = new Cartesian3(...o);
            // As it is: the constructor would normalize once more.
            ray.direction = new Cartesian3(...d);
            return IntersectionTests.rayTriangle(ray, a, b, c) !== undefined;
        };
        return { hit, contract: `${PROMISE},direction=unit:4` };
    },
    playcanvas: async () => {
        const { Ray, Tri, Vec3 } = await import("playcanvas");
        const hit = (o, d, ...triangle) => {
            const ray = new Ray();
            // The constructor's arguments are copied; a direction is taken as it is.
            ray.origin.set(...o);
            ray.direction.set(...d);
            return new Tri(...triangle.map((p) => new Vec3(...p))).intersectsRay(ray);
        };
        return { hit, contract: `${PROMISE},direction=unit:4` };
    },
    "ray-triangle-intersection": async () => {
        const { default: intersect } = await import("ray-triangle-intersection");
        const hit = (o, d, ...triangle) => intersect([0, 0, 0], o, d, triangle) !== null;
        return { hit, contract: PROMISE.replace("both", "front") };
    },
    claygl: async () => {
        const { Ray, Vector3 } = (await import("claygl")).default ?? (await import("claygl"));
        const hit = (o, d, ...triangle) => {
            const [a, b, c] = triangle.map((p) => new Vector3(...p));
            const ray = new Ray(new Vector3(...o), new Vector3(...d));
            return ray.intersectTriangle(a, b, c, false) !== null;
        };
        return { hit, scalar: "f32" };
    },
    yuka: async () => {
        const { Ray, Vector3 } = await import("yuka");
        const hit = (o, d, ...triangle) => {
            const [a, b, c] = triangle.map((p) => new Vector3(...p));
            const ray = new Ray(new Vector3(...o), new Vector3(...d));
            return ray.intersectTriangle({ a, b, c }, false, new Vector3()) !== null;
        };
        return { hit };
    },
    ogl: async () => {
        const { Raycast, Vec3 } = await import("ogl");
        const caster = new Raycast();
        const hit = (o, d, ...triangle) => {
            const [a, b, c] = triangle.map((p) => new Vec3(...p));
            // 0 is a miss.
            return caster.intersectTriangle(a, b, c, false, new Vec3(...o), new Vec3(...d)) !== 0;
        };
        return { hit };
    },
};

const name = process.argv[2];
if (!(name in kernels)) {
    console.error(`usage: kernel.mjs ${Object.keys(kernels).join("|")}`);
    process.exit(2);
}
const { hit, scalar = "f64", contract = PROMISE } = await kernels[name]();
process.stdout.write(`hairline-kernel 1\nname ${name}\nscalars ${scalar}\ncontract ${contract}\nready\n`);

// JavaScript reads Infinity where the protocol has inf.
const numberOf = (word) => Number(word.replace("inf", "Infinity"));
let answers = [];
for await (const line of createInterface({ input: process.stdin })) {
    const words = line.split(" ");
    if (words[0] === "case") {
        const numbers = words.slice(3).map(numberOf);
        const vectors = [0, 3, 6, 9, 12].map((i) => numbers.slice(i, i + 3));
        answers.push(`${words[1]} ${hit(...vectors) ? "hit" : "miss"}\n`);
    } else if (words[0] === "end") {
        answers.push(`${line}\n`);
    }
    if (words[0] === "end" || answers.length >= 4096) {
        process.stdout.write(answers.join(""));
        answers = [];
    }
}
