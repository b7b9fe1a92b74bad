/** Which version this is, what it is based on, and on which terms. */

import { version } from "../../package.json";
import { Modal } from "./modal";

export function About() {
  return (
    <Modal name="About" title={`verne ${version}`}>
      <p>
        Kinematics, workspaces and tool paths of the VERNE machine’s architecture: a platform on three legs
        with vertical sliders, above a table that tilts and turns.
      </p>
      <p>
        Equations and limits are those of D. Kanaan, P. Wenger, D. Chablat,{" "}
        <cite>Workspace and Kinematic Analysis of the VERNE machine</cite>, AIM 2007,{" "}
        <a href="https://arxiv.org/abs/0707.3507">arXiv:0707.3507</a>.
      </p>
      <p>
        The built-in machine’s dimensions are invented: round numbers that reproduce the solution counts of
        the paper. They are not Fatronik’s.
      </p>
      <p>
        Collisions with the part and with fixtures are not checked. verne computes kinematics; it is no safety
        function of a machine.
      </p>
      <p>Licence: MIT or Apache-2.0, at your choice.</p>
      <p>
        <a href="guide">Guide</a>, <a href="docs/">operations of the API</a>
      </p>
    </Modal>
  );
}
