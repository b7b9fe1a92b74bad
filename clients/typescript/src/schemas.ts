/** The types of the service's requests and answers, from its OpenAPI document. */

import type { components } from "../generated/openapi.js";

export type { paths } from "../generated/openapi.js";

export type Schemas = components["schemas"];
export type Answer = Schemas["Answer"];
export type Atlas = Schemas["Atlas"];
export type AtlasRequest = Schemas["AtlasRequest"];
export type AtlasSpace = Schemas["AtlasSpace"];
export type CalibrationAnswer = Schemas["CalibrationAnswer"];
export type CalibrationRequest = Schemas["CalibrationRequest"];
export type DexterityBody = Schemas["DexterityBody"];
export type DexteritySummary = Schemas["DexteritySummary"];
export type ErrorBudgetAnswer = Schemas["ErrorBudgetAnswer"];
export type ErrorBudgetRequest = Schemas["ErrorBudgetRequest"];
export type ErrorMapRequest = Schemas["ErrorMapRequest"];
export type ErrorMapSummary = Schemas["ErrorMapSummary"];
export type FamilySummary = Schemas["FamilySummary"];
export type Job = Schemas["Job"];
export type Limit = Schemas["Limit"];
export type Machine = Schemas["Machine"];
export type MachineRef = Schemas["MachineRef"];
export type Margins = Schemas["Margins"];
export type OriginsRequest = Schemas["OriginsRequest"];
export type OriginsSummary = Schemas["OriginsSummary"];
export type Placement = Schemas["Placement"];
export type PlacementRequest = Schemas["PlacementRequest"];
export type PlatformPose = Schemas["PlatformPose"];
export type Problem = Schemas["Problem"];
export type Slice = Schemas["Slice"];
export type Solution = Schemas["Solution"];
export type ToolpathReport = Schemas["ToolpathReport"];
export type ToolpathRequest = Schemas["ToolpathRequest"];
export type Window = Schemas["Window"];
export type WindowRequest = Schemas["WindowRequest"];
export type WorkspaceKind = Schemas["WorkspaceKind"];
export type WorkspaceRequest = Schemas["WorkspaceRequest"];
export type WorkspaceSummary = Schemas["WorkspaceSummary"];
