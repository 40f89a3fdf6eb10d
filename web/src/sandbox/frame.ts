// The script of sandbox.html, which the page opens in a frame with `sandbox="allow-scripts"`. It starts a worker for one
// kernel, hands it the port on which numbers come and go, and does no more.
//
// Why a worker: one in a frame that does not end would freeze the page where the two share a thread, and a document can
// leave for another address with what it knows, which no policy forbids. A worker can do neither.
// Why from a `data:` address: such a worker has an opaque origin wherever it is made, and takes over the policy of this
// file, which has no address in it. A `blob:` worker would have the origin of the frame.
import workerText from "virtual:sandbox-worker";

// Outside of a sandbox this file has the origin of the page, and does nothing.
if (self.origin === "null") {
  addEventListener("message", ({ data, ports, source }) => {
    if (source !== parent) return;
    const worker = new Worker(`data:text/javascript;charset=utf-8,${encodeURIComponent(workerText)}`, { type: "module" });
    // Only that it does not start. Later errors are the kernel's own, where nobody waits for it.
    let isThere = false;
    worker.onmessage = () => { isThere = true; };
    worker.onerror = (event) => {
      event.preventDefault();
      if (!isThere) parent.postMessage("no worker", "*");
    };
    worker.postMessage(data, [...ports]);
  }, { once: true });
}
