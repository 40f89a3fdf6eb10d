// What the build puts in (bundle.mjs).
declare module "virtual:worker" {
  const text: string;
  export default text;
}
declare module "virtual:mesh-script" {
  const text: string;
  export default text;
}
