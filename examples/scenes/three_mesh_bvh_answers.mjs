// three-mesh-bvh's nearest hits (npm three, three-mesh-bvh) for `hairline rays`; after `npm ci`:
//     node three_mesh_bvh_answers.mjs model.obj rays.csv > answers.csv
import { readFileSync } from "node:fs";
import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from "three";
import { MeshBVH } from "three-mesh-bvh";

const lines = (file) => readFileSync(file, "utf8").trim().split("\n");
const rows = (word) => lines(process.argv[2]).filter((line) => line.startsWith(`${word} `)).map((line) => line.split(" ").slice(1));
const vertices = rows("v").flat().map(Number);
const faces = rows("f").flat().map((corner) => parseInt(corner) - 1); // triangles, in the order of the file
const geometry = new BufferGeometry().setIndex(faces);
geometry.setAttribute("position", new BufferAttribute(new Float32Array(vertices), 3));
const tree = new MeshBVH(geometry, { indirect: true }); // which leaves the faces in their order

const answers = lines(process.argv[3]).slice(1).map((line) => {
    const numbers = line.split(",").map(Number);
    const [origin, direction] = [0, 3].map((i) => new Vector3(...numbers.slice(i, i + 3)));
    const length = direction.length(); // a direction of three's is a unit vector
    const hit = tree.raycastFirst(new Ray(origin, direction.normalize()), DoubleSide);
    return hit ? `${hit.faceIndex},${hit.distance / length}\n` : "-1\n";
});
process.stdout.write(answers.join(""));
