// SPDX-License-Identifier: MIT
import type { Problem } from '../data/types';

/** What is wrong and what to do, in the program's words. */
export function ProblemNote({ problem }: { problem: Problem }) {
  return (
    <div class="problem" role="alert">
      <p>{problem.message}</p>
      {problem.hint && <p class="hint">{problem.hint}</p>}
    </div>
  );
}
