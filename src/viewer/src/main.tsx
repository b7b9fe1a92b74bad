/** Starts the page. */

import { effect } from "@preact/signals";
import { render } from "preact";
import { Page } from "./panels/page";
import { keepAtlasPanel } from "./atlas/entry";
import { keepDexterityPanel } from "./dexterity/entry";
import { keepErrorsPanel } from "./errors/entry";
import { keepFamilyPanel } from "./families/entry";
import { followLinks } from "./program/entry";
import { keepAddress, onNewAddress, saidByAddress } from "./state/address_bar";
import { keepWorkspace } from "./state/computation";
import { keepHistory } from "./state/history";
import { keepJointWays } from "./state/joint_ways";
import { follow } from "./state/link";
import { listMachines } from "./state/machines";
import { stay } from "./state/motion";
import { ghostKind, machine, overTable, tool } from "./state/store";

async function start(): Promise<void> {
  // The requests are under way while the page is made.
  const first = follow(await saidByAddress());
  const root = document.getElementById("page");
  if (root) render(<Page />, root);
  void listMachines().catch(() => undefined);
  // The workspace does not wait for the position: at home it is asked for as soon as the machine is known.
  keepWorkspace();
  keepJointWays();
  await first;
  keepHistory();
  keepAddress();
  onNewAddress((said) => void follow(said));
  followTool();
  followLinks();
  keepFamilyPanel();
  keepDexterityPanel();
  keepErrorsPanel();
  keepAtlasPanel();
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
