/** Starts the page. */

import { effect } from "@preact/signals";
import { render } from "preact";
import { inWords } from "./api/client";
import { Page } from "./panels/page";
import { followLinks } from "./program/entry";
import { keepAddress, onNewAddress, viewOfAddress } from "./state/address_bar";
import { keepWorkspace } from "./state/computation";
import { listMachines, loadMachine } from "./state/machines";
import { stay } from "./state/motion";
import { failure, ghostKind, machine, overTable, tool, view } from "./state/store";
import type { View } from "./state/view";

async function load(next: View): Promise<void> {
  view.value = next;
  try {
    await loadMachine(next);
  } catch (thrown) {
    failure.value = inWords(thrown);
  }
}

async function start(): Promise<void> {
  const root = document.getElementById("page");
  if (root) render(<Page />, root);
  const first = viewOfAddress().then(load);
  void listMachines().catch(() => undefined);
  await first;
  keepWorkspace();
  keepAddress();
  onNewAddress((next) => void load(next));
  followTool();
  followLinks();
}

/** Another tool, another height over the table or other ghosts: the same joints are solved anew. */
function followTool(): void {
  let before = "";
  effect(() => {
    const now = `${tool.value} ${JSON.stringify(overTable.value)} ${ghostKind.value}`;
    if (before !== "" && now !== before && machine.peek()) stay();
    before = now;
  });
}

void start();
