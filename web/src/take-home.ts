// A kernel of the page as a file that `hairline --kernel-cmd 'node kernel.mjs'` takes (docs/protocol.md).
import { decimal, type Described } from "./kernel.js";

/** The file: the kernel's text, and below it the protocol. */
export function takeHome(text: string, { epsilons, contract, gives }: Described): string {
  const values = [...(gives[0] ? ["t"] : []), ...(gives[1] ? ["uv"] : [])].join(" ");
  const hello = [
    "hairline-kernel 1", "name yours", "scalars f32 f64", `contract ${contract}`, `gives ${values}`,
    ...Object.entries(epsilons).map(([name, value]) => `epsilon ${name} ${decimal(value)} 0 0 signed as the kernel compares it with e`),
    "ready", "",
  ].join("\n");
  return `${text}
// Below: how it talks to hairline, which starts it by --kernel-cmd 'node kernel.mjs'.
(async () => {
  const [{ createInterface }, { default: test }] = await Promise.all([import("node:readline"), import(import.meta.url)]);
  const names = ${JSON.stringify(Object.keys(epsilons))};
  let epsilon = ${JSON.stringify(epsilons)};
  process.stdout.write(${JSON.stringify(hello)});
  const number = (word) => Number(word.replace("inf", "Infinity"));
  const answer = (id, words) => {
    const n = words.map(number);
    const [origin, direction, a, b, c] = [0, 3, 6, 9, 12].map((i) => n.slice(i, i + 3));
    const hit = test({ origin, direction, tMin: n[15], tMax: n[16] }, { a, b, c }, epsilon);
    if (hit === null || hit === undefined || hit === false) return \`\${id} miss\\n\`;
    const values = hit === true ? {} : typeof hit === "number" ? { t: hit } : hit;
    const given = ${JSON.stringify([...(gives[0] ? ["t"] : []), ...(gives[1] ? ["u", "v"] : [])])};
    return \`\${id} hit\${given.map((name) => \` \${name}=\${values[name] ?? NaN}\`).join("")}\\n\`;
  };
  let answers = [];
  for await (const line of createInterface({ input: process.stdin })) {
    const [word, ...rest] = line.split(" ");
    if (word === "epsilons") epsilon = Object.fromEntries(names.map((name, i) => [name, number(rest[i + 1])]));
    if (word === "case") answers.push(answer(rest[0], rest.slice(2)));
    if (word === "end") answers.push(\`\${line}\\n\`);
    if (word === "end" || answers.length >= 4096) {
      process.stdout.write(answers.join(""));
      answers = [];
    }
  }
})();
`;
}
