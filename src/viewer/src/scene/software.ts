/** How this browser draws. */

const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;

/** With the processor alone, not at all, or properly. */
export function drawing(): "software" | "none" | "hardware" {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return "none";
  const known = gl.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = known ? gl.getParameter(known.UNMASKED_RENDERER_WEBGL) : "";
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(String(name)) ? "software" : "hardware";
}
