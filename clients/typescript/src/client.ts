/** The client: requests with types, results that jobs compute, and meshes. */

import createClient, { type Client } from "openapi-fetch";
import { isJob, jobEvents, resultOf, type Watch } from "./jobs.js";
import { linked } from "./links.js";
import { readProblem, unwrap } from "./problem.js";
import { retrying, type Send } from "./retry.js";
import type {
  Atlas,
  AtlasRequest,
  CalibrationAnswer,
  CalibrationRequest,
  DexterityBody,
  DexteritySummary,
  ErrorBudgetAnswer,
  ErrorBudgetRequest,
  ErrorMapRequest,
  ErrorMapSummary,
  FamilySummary,
  Job,
  OriginsRequest,
  OriginsSummary,
  paths,
  Placement,
  PlacementRequest,
  ToolpathReport,
  ToolpathRequest,
  Window,
  WindowRequest,
  WorkspaceRequest,
  WorkspaceSummary,
} from "./schemas.js";

/** Settings of a client. */
export interface Options {
  /** The API key of a service that was started with `--keys`. */
  key?: string;
  /** Sends requests; the default is the `fetch` of the platform. */
  fetch?: Send;
  /** How often a request is sent at most, if the service answers with Retry-After. The default is 4. */
  attempts?: number;
}

/** How a client waits for a result. */
export interface Wait extends Watch {
  /** Seconds that the service computes before it answers with a job. The service has a default. */
  wait?: number;
}

/** A format of mesh files. */
export type MeshFormat = "glb" | "stl" | "ply";

/** Which set of a dexterity map a mesh surrounds. */
export type MeshSet = "reachable" | "dexterous";

/** An error of the tool, by which the mesh of an error map is coloured. */
export type MeshError = "tip_rms" | "tip_worst" | "axis_rms" | "axis_worst";

/** A client of the service at one address. */
export class Verne {
  /** Every operation of the OpenAPI document, by path and method. */
  readonly api: Client<paths>;
  private readonly base: string;
  private readonly send: Send;

  constructor(
    base: string,
    { key, fetch: platform = (request) => fetch(request), attempts = 4 }: Options = {},
  ) {
    this.base = base.replace(/\/$/, "");
    const keyed: Send = (request) => {
      if (key !== undefined) request.headers.set("authorization", `Bearer ${key}`);
      return platform(request);
    };
    this.send = retrying(keyed, attempts);
    this.api = createClient<paths>({ baseUrl: this.base, fetch: this.send });
  }

  /** The address of a link in an answer. */
  address(link: string): string {
    return linked(this.base, link);
  }

  /** The volume, the bounds and the links of a workspace. */
  async workspace(body: WorkspaceRequest, options: Wait = {}): Promise<WorkspaceSummary | FamilySummary> {
    return this.settled(unwrap(await this.api.POST("/workspace", { body, ...asked(options) })), options);
  }

  /** The summary of a dexterity map. */
  async dexterity(body: DexterityBody, options: Wait = {}): Promise<DexteritySummary> {
    return this.settled(
      unwrap(await this.api.POST("/workspace/dexterity", { body, ...asked(options) })),
      options,
    );
  }

  /** In which parts of a plane the parallel module has how many solutions. */
  async atlas(body: AtlasRequest = {}): Promise<Atlas> {
    return unwrap(await this.api.POST("/atlas", { body }));
  }

  /** How far the tool may be off at each of the poses, for tolerances of the machine's parameters. */
  async errorBudget(body: ErrorBudgetRequest): Promise<ErrorBudgetAnswer> {
    return unwrap(await this.api.POST("/error-budget", { body }));
  }

  /** The summary of the errors of the tool over a workspace. */
  async errorMap(body: ErrorMapRequest, options: Wait = {}): Promise<ErrorMapSummary> {
    return this.settled(
      unwrap(await this.api.POST("/workspace/error-budget", { body, ...asked(options) })),
      options,
    );
  }

  /** The report on a tool path. */
  async toolpath(body: ToolpathRequest, options: Wait = {}): Promise<ToolpathReport> {
    return this.settled(unwrap(await this.api.POST("/toolpath", { body, ...asked(options) })), options);
  }

  /** The values of a parameter with which the machine can run a program. */
  async window(body: WindowRequest, options: Wait = {}): Promise<Window> {
    return this.settled(
      unwrap(await this.api.POST("/toolpath/window", { body, ...asked(options) })),
      options,
    );
  }

  /** The set-up in which a program keeps the greatest distance from the limits. */
  async placement(body: PlacementRequest, options: Wait = {}): Promise<Placement> {
    return this.settled(
      unwrap(await this.api.POST("/toolpath/placement", { body, ...asked(options) })),
      options,
    );
  }

  /** The summary of the region of origins of a program; `links.mesh` is its surface. */
  async origins(body: OriginsRequest, options: Wait = {}): Promise<OriginsSummary> {
    return this.settled(
      unwrap(await this.api.POST("/toolpath/origins", { body, ...asked(options) })),
      options,
    );
  }

  /** The parameters of a machine as measurements determine them. `machine` of the answer is ready for requests. */
  async calibrate(body: CalibrationRequest): Promise<CalibrationAnswer> {
    return unwrap(await this.api.POST("/machines/calibration", { body }));
  }

  /** A file of a stored result, such as `/workspace/ID/mesh.glb`. If the service evicted it, a job computes it again. */
  async file(path: string, watch: Watch = {}): Promise<ArrayBuffer> {
    const response = await this.get(path, watch.signal);
    if (response.status !== 202) return response.arrayBuffer();
    await this.finished((await response.json()) as Job, watch);
    return this.file(path, watch);
  }

  /** The mesh of a stored workspace, dexterity map or error map. */
  mesh(
    id: string,
    format: MeshFormat = "glb",
    watch: Watch & { set?: MeshSet; error?: MeshError } = {},
  ): Promise<ArrayBuffer> {
    const { set, error } = watch;
    const query = new URLSearchParams({ ...(set && { set }), ...(error && { error }) });
    const suffix = query.size > 0 ? `?${query.toString()}` : "";
    return this.file(`/workspace/${encodeURIComponent(id)}/mesh.${format}${suffix}`, watch);
  }

  /** The result of an answer that is the result, or the job that computes it. */
  async settled<T extends object>(answer: T, watch: Watch = {}): Promise<Exclude<T, Job>> {
    if (!isJob(answer)) return answer as Exclude<T, Job>;
    const result = await this.finished(answer, watch);
    return (await (await this.get(result, watch.signal)).json()) as Exclude<T, Job>;
  }

  /** Waits until a job has ended. Returns the path of its result, or throws its problem. */
  async finished(job: Job, { onProgress, signal }: Watch = {}): Promise<string> {
    for await (const state of this.events(job, signal)) {
      onProgress?.(state);
      const result = resultOf(state);
      if (result !== null) return result;
    }
    throw new Error(`The stream of events of job ${job.id} ended before the job.`);
  }

  /** The states of a job, one at once and one at each change, until it has ended. */
  events(job: Job, signal?: AbortSignal): AsyncGenerator<Job, void> {
    return jobEvents(this.send, this.address(job.links.events), signal);
  }

  /** Cancels a job. */
  async cancel(id: string): Promise<Job> {
    return unwrap(await this.api.DELETE("/jobs/{id}", { params: { path: { id } } }));
  }

  private async get(link: string, signal?: AbortSignal): Promise<Response> {
    const response = await this.send(new Request(this.address(link), { signal: signal ?? null }));
    if (!response.ok) throw await readProblem(response);
    return response;
  }
}

/** What a request says about the wait. */
function asked({ wait, signal }: Wait): { headers: Record<string, string>; signal: AbortSignal | null } {
  return { headers: wait === undefined ? {} : { prefer: `wait=${wait}` }, signal: signal ?? null };
}
