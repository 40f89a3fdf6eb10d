// three.js' Ray.intersectTriangle, without culling, as a kernel for hairline (docs/protocol.md).
// Its documentation calls the direction normalized, and its source says that "the ray can never fall
// between" two triangles that share an edge; what it makes of an edge singly it does not say.
import { createInterface } from "node:readline";
import { Ray, REVISION, Vector3 } from "three";

const hello = `hairline-kernel 1
name three-js
source three ${REVISION}, Ray.intersectTriangle without culling
scalars f64
contract extent=ray,sides=both,boundary=free,ends=free,coplanar=free,degenerate=free,direction=unit:4,across=at-least-one
ready
`;

// JavaScript writes and reads Infinity where the protocol has inf.
const numberOf = (word) => Number(word.replace("inf", "Infinity"));

function answer(words) {
    const numbers = words.slice(3).map(numberOf);
    const [origin, direction, a, b, c] = [0, 3, 6, 9, 12].map(
        (i) => new Vector3(numbers[i], numbers[i + 1], numbers[i + 2]),
    );
    const ray = new Ray(origin, direction);
    return ray.intersectTriangle(a, b, c, false, new Vector3()) === null ? "miss" : "hit";
}

process.stdout.write(hello);
let answers = [];
for await (const line of createInterface({ input: process.stdin })) {
    const words = line.split(" ");
    if (words[0] === "case") {
        answers.push(`${words[1]} ${answer(words)}\n`);
    } else if (words[0] === "end") {
        answers.push(`${line}\n`);
    }
    if (words[0] === "end" || answers.length >= 4096) {
        process.stdout.write(answers.join(""));
        answers = [];
    }
}
