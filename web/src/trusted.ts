// The page's policy lets nothing but a named maker turn text into an address of a script (Trusted Types): DOMPurify makes
// no such address, and this is called with one `blob:` of the judge's own text.

interface Makers { createPolicy(name: string, makers: { createScriptURL(address: string): string }): { createScriptURL(address: string): string } }

const maker = (globalThis as { trustedTypes?: Makers }).trustedTypes?.createPolicy("hairline", {
  createScriptURL(address) {
    if (!address.startsWith(`blob:${location.origin}/`)) throw new TypeError("not a script of the page's own");
    return address;
  },
});

/** The address of a script, for a worker. */
export const scriptAddress = (address: string): string => maker?.createScriptURL(address) ?? address;
