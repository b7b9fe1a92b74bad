/** The client and a real service. */

import assert from "node:assert/strict";
import { suite, test } from "node:test";
import { CancelledError, ProblemError, unwrap, Verne, type Job } from "verne-client";
import { serve } from "./service.js";

const verne = new Verne(await serve());

suite("a client of a service", () => {
  test("inverse kinematics needs the position only", async () => {
    const body = { pose: { x: 100, y: 50, z: 150 }, tool_length: 50 };
    const { solutions } = unwrap(await verne.api.POST("/ik", { body }));
    assert.equal(solutions.length, 1);
    const query = { x: 100, y: 50, z: 150, tool_length: 50 };
    const same = unwrap(await verne.api.GET("/ik", { params: { query } }));
    assert.deepEqual(same.solutions, solutions);
  });

  test("a batch answers each row", async () => {
    const poses = [[100, 50, 150, 0, 0], null, [0, 0, 9000, 0, 0]];
    const { status, joints } = unwrap(
      await verne.api.POST("/ik/batch", { body: { poses, tool_length: 50 } }),
    );
    assert.deepEqual(status, ["ok", "invalid", "infeasible"]);
    assert.equal(joints[0]?.length, 5);
  });

  test("a problem has its code and the pointers of its fields", async () => {
    const body = { pose: { x: 100, y: 50, z: 150 }, tool_length: -1 };
    const answer = await verne.api.POST("/ik", { body });
    assert.throws(
      () => unwrap(answer),
      (error: unknown) => {
        assert.ok(error instanceof ProblemError);
        assert.deepEqual([error.status, error.code], [422, "invalid_request"]);
        const [fault] = error.errors;
        assert.ok(fault && "pointer" in fault && fault.pointer === "/tool_length");
        return true;
      },
    );
    await assert.rejects(verne.mesh("nothing"), { code: "workspace_not_found" });
  });

  test("a workspace reports its progress, and has a mesh", async () => {
    const states: Job[] = [];
    const onProgress = (job: Job) => void states.push(job);
    const request = { kind: "part" as const, tool_length: 50, tolerance: 2 };
    const summary = await verne.workspace(request, { wait: 0, onProgress });
    assert.ok("volume" in summary && summary.volume !== null && summary.volume > 0);
    assert.equal(states.at(-1)?.state, "succeeded");
    const progress = states.map((job) => job.progress);
    assert.deepEqual(
      progress,
      [...progress].sort((a, b) => a - b),
    );
    // The result is stored, so there is no job.
    states.length = 0;
    assert.deepEqual(await verne.workspace(request, { onProgress }), summary);
    assert.equal(states.length, 0);

    const glb = new DataView(await verne.mesh(summary.id));
    assert.deepEqual([glb.getUint32(0, true), glb.getUint32(8, true)], [0x46546c67, glb.byteLength]);
    const stl = await verne.mesh(summary.id, "stl");
    assert.equal(new DataView(stl).getUint32(80, true), summary.triangles);
  });

  test("a job that is cancelled ends the wait", async () => {
    const request = { kind: "part" as const, tool_length: 50, tolerance: 0.02 };
    const cancelled = verne.workspace(request, {
      wait: 0,
      onProgress: (job) => {
        if (job.state === "running") void verne.cancel(job.id);
      },
    });
    await assert.rejects(cancelled, CancelledError);
  });

  test("an aborted wait leaves the job", async () => {
    const abort = new AbortController();
    let job: Job | undefined;
    const request = { kind: "tool" as const, tool_length: 50, tolerance: 0.02 };
    const aborted = verne.workspace(request, {
      wait: 0,
      signal: abort.signal,
      onProgress: (state) => {
        job = state;
        abort.abort();
      },
    });
    await assert.rejects(aborted, { name: "AbortError" });
    assert.ok(job);
    const { state } = await verne.cancel(job.id);
    assert.notEqual(state, "succeeded");
  });

  test("a family and a dexterity map are results, too", async () => {
    const family = await verne.workspace({ kind: "tool", tool_length: [0, 100], tolerance: 20 }, { wait: 0 });
    assert.ok("members" in family && family.members.length === 2);
    const phi1 = { from: -20, to: 20 };
    const map = await verne.dexterity({ tool_length: 50, phi1, cell: 400 }, { wait: 0 });
    assert.ok((await verne.mesh(map.id, "ply", { set: "dexterous" })).byteLength > 0);
  });

  test("an atlas has regions that are the window, and drawings", async () => {
    const { window, regions } = await verne.atlas({ space: "joints", tolerance: 5 });
    const [left = 0, right = 0] = window.u;
    const [low = 0, high = 0] = window.v;
    const whole = regions.reduce((sum, { area }) => sum + area, 0);
    assert.ok(Math.abs(whole / ((right - left) * (high - low)) - 1) < 1e-4);
    const body = { space: "platform" as const, tolerance: 20 };
    const svg = unwrap(await verne.api.POST("/atlas.svg", { body, parseAs: "text" }));
    assert.ok(svg.startsWith("<svg"));
  });

  test("an error budget names its parameters, and an error map has a mesh for each error", async () => {
    const parameter_tolerances = { L1: 0.02, tilt_zero: 0.001 };
    const { parameters, budgets, status } = await verne.errorBudget({
      poses: [[100, 50, 150, 0, 0], null],
      tool_length: 50,
      parameter_tolerances,
    });
    assert.deepEqual(
      parameters.map(({ name }) => name),
      Object.keys(parameter_tolerances),
    );
    assert.deepEqual(status, ["ok", "invalid"]);
    const [budget, none] = budgets;
    assert.ok(budget && budget.tip.rms > 0 && none === null);
    assert.ok(Math.abs(budget.tip.rms - Math.hypot(...budget.tip.contributions)) < 1e-12);

    const body = { kind: "tool" as const, tool_length: 50, cell: 200, tolerance: 20, parameter_tolerances };
    const map = await verne.errorMap(body, { wait: 0 });
    assert.ok(map.errors && map.errors.tip_worst.least <= map.errors.tip_worst.largest);
    const stl = new DataView(await verne.mesh(map.id, "stl", { error: "axis_rms" }));
    assert.equal(stl.getUint32(80, true), map.triangles);
  });

  test("measurements determine a machine", async () => {
    const rho = Array.from({ length: 12 }, (_, i): [number, number, number] => [
      450 + 100 * Math.sin(0.7 * i),
      450 + 100 * Math.sin(1.3 * i),
      450 + 100 * Math.cos(2.1 * i),
    ]);
    const plan = await verne.calibrate({ rho, kind: "tracker", tool_length: 100 });
    assert.deepEqual([plan.rank, plan.unknowns, plan.rms], [17, 19, null]);
    const points: [number, number, number][] = [];
    for (const joints of rho) {
      const machine = { ...plan.machine, geometry: { ...plan.machine.geometry, L1: 1050.3 } };
      const body = { joints: { rho: joints }, tool_length: 100, machine };
      const [solution] = unwrap(await verne.api.POST("/fk", { body })).solutions;
      assert.ok(solution);
      points.push([solution.tool.x, solution.tool.y, solution.tool.z]);
    }
    const found = await verne.calibrate({ rho, points, tool_length: 100, sigma: 0.002 });
    assert.ok(Math.abs(found.machine.geometry.L1 - 1050.3) < 1e-4);
    const body = { joints: { rho: [500, 480, 520] as [number, number, number] }, machine: found.machine };
    assert.equal(unwrap(await verne.api.POST("/fk", { body })).machine.hash, found.hash);
    const unfit = verne.calibrate({ rho, points: rho, tool_length: 100, sigma: 0.002 });
    await assert.rejects(unfit, { status: 422, code: "no_fit" });
  });

  test("a tool path has a report, rows and a program", async () => {
    const start = { x: 0, y: 0, i: 0, j: 0, k: 1, feed: 800 };
    const end = { x: 80, y: 0, z: 300, i: 0, j: 0.6, k: 0.8, feed: 800 };
    const program = { points: [{ ...start, z: 350 }, { ...start, z: 300 }, end] };
    const report = await verne.toolpath({ program, tool_length: 120 });
    assert.equal(report.failure_count, 0);
    const path = { id: report.id };
    const answer = unwrap(await verne.api.GET("/toolpath/{id}/rows.json", { params: { path } }));
    assert.ok("rows" in answer && answer.rows.length === report.rows);
    assert.ok(report.links.program);
    const text = new TextDecoder().decode(await verne.file(report.links.program));
    assert.ok(text.includes("G1 "));
  });
});
