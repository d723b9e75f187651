// SPDX-License-Identifier: MIT
import { problems, session } from '../state/session';
import { ProblemNote } from '../ui/problem_note';

/** The files that were opened, and what is wrong with those that could not be. */
export function FileList() {
  return (
    <ul>
      {session.value?.files.map((file) => (
        <li key={file.id} title={file.path}>
          {file.name}
          {problems.value.has(file.id) && <ProblemNote problem={problems.value.get(file.id)!} />}
        </li>
      ))}
    </ul>
  );
}
