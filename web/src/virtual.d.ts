// What the build puts in (bundle.mjs).
declare module "virtual:judge" {
  const text: string;
  export default text;
}
declare module "virtual:sandbox-worker" {
  const text: string;
  export default text;
}
declare module "virtual:mesh-script" {
  /** Draws the mesh that the page has now. */
  export default function (): void;
}
