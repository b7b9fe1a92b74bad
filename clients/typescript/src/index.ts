/** Types and a thin client of verne. */

export { Verne, type MeshError, type MeshFormat, type MeshSet, type Options, type Wait } from "./client.js";
export { CancelledError, isJob, type Watch } from "./jobs.js";
export { ProblemError, unwrap } from "./problem.js";
export type { Send } from "./retry.js";
export type * from "./schemas.js";
