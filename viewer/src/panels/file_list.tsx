// SPDX-License-Identifier: MIT
// The files that were opened: what they are, which clips are shown and in which colour, and what is wrong with those that
// could not be read.
import type { FileEntry, Problem } from '../data/types';
import { choose, chosen, isChosen, numbers, setReference } from '../state/compare';
import { clipsListedBy, type FileGroup, fileGroups } from '../state/file_groups';
import { leftOut, nameOf } from '../state/names';
import { loadedClips, mode, namedClips, numLoading, problems, session } from '../state/session';
import { actors } from '../state/stage';
import { written } from '../state/ticks';
import { FileName } from '../ui/file_name';
import { ProblemNote } from '../ui/problem_note';
import { Swatch } from '../ui/swatch';
import './file_list.css';

/** The number that tells a clip from the others on the stage; none if it is not there. */
function numberOf(id: string): number | undefined {
  const shown = actors.value.find((actor) => actor.clip.id === id);
  return shown?.colour ?? (mode.value === 'compare' && isChosen(id) ? numbers.value.get(id) : undefined);
}

/** What reading the file had to say; folded, since the clip was read all the same. */
function Notes({ notes }: { notes: readonly Problem[] }) {
  if (notes.length === 0) return null;
  return (
    <details class="notes">
      <summary>{notes.length === 1 ? '1 note' : `${notes.length} notes`} from reading it</summary>
      {notes.map((note) => (
        <p key={note.message}>
          {note.message}
          {note.hint && <span class="hint"> {note.hint}</span>}
        </p>
      ))}
    </details>
  );
}

function ClipFacts({ id }: { id: string }) {
  const clip = loadedClips.value.get(id);
  if (!clip) return null;
  const { frameRate, numFrames, notes } = clip.header;
  return (
    <>
      <p class="facts number">
        {written(clip.duration)} s, {numFrames}&nbsp;frames at {Number(frameRate.toFixed(2))}&nbsp;Hz
      </p>
      <Notes notes={notes} />
    </>
  );
}

/** Puts a clip on the stage of Compare, and makes it the one that the others follow. */
function ClipChoice({ file }: { file: FileEntry }) {
  const isOn = isChosen(file.id);
  const isReference = isOn && chosen.value[0] === file.id;
  return (
    <>
      <label class="name">
        <input
          type="checkbox"
          checked={isOn}
          disabled={problems.value.has(file.id)}
          onChange={(event) => choose(file.id, event.currentTarget.checked)}
        />
        <Swatch number={numberOf(file.id)} />
        <FileName name={nameOf(file.id)} />
      </label>
      {isOn && chosen.value.length > 1 && (
        <button
          type="button"
          class="plain reference"
          aria-pressed={isReference}
          title={isReference ? 'The others follow this clip' : 'Let the others follow this clip'}
          onClick={() => setReference(file.id)}
        >
          {isReference ? 'reference' : 'make reference'}
        </button>
      )}
    </>
  );
}

function Clip({ file }: { file: FileEntry }) {
  return (
    <li title={file.path} class={numberOf(file.id) === undefined ? 'clip' : 'clip shown'}>
      {mode.value === 'compare' ? (
        <ClipChoice file={file} />
      ) : (
        <p class="name">
          <Swatch number={numberOf(file.id)} />
          <FileName name={nameOf(file.id)} />
        </p>
      )}
      <ClipFacts id={file.id} />
      {problems.value.has(file.id) && <ProblemNote problem={problems.value.get(file.id)!} />}
    </li>
  );
}

function ListedClips({ list }: { list: FileEntry }) {
  const listed = clipsListedBy(list.id, session.value!.files);
  if (listed.length === 0) return null;
  return (
    <details>
      <summary>{listed.length === 1 ? '1 clip' : `${listed.length} clips`}</summary>
      <ul>
        {listed.map((file) => (
          <Clip key={file.id} file={file} />
        ))}
      </ul>
    </details>
  );
}

function OtherFile({ file }: { file: FileEntry }) {
  return (
    <li title={file.path}>
      <p class="name">
        <FileName name={file.name} />
      </p>
      {problems.value.has(file.id) && <ProblemNote problem={problems.value.get(file.id)!} />}
      <ListedClips list={file} />
    </li>
  );
}

function Group({ group }: { group: FileGroup }) {
  return (
    <section class="part">
      <h2>{group.title}</h2>
      {group.kind === 'clip' && leftOut.value && (
        <p class="facts" title="All names begin so; the list leaves it out">
          <FileName name={leftOut.value} />…
        </p>
      )}
      <ul>
        {group.files.map((file) =>
          file.kind === 'clip' ? <Clip key={file.id} file={file} /> : <OtherFile key={file.id} file={file} />,
        )}
      </ul>
    </section>
  );
}

function Loading() {
  if (numLoading.value === 0) return null;
  const total = namedClips.value.length;
  return (
    <div class="part" role="status">
      <label>
        Reading clips: {total - numLoading.value} of {total}
        <progress value={total - numLoading.value} max={total} />
      </label>
    </div>
  );
}

export function FileList() {
  const groups = fileGroups(session.value?.files ?? []);
  return (
    <div class="file-list">
      <Loading />
      {groups.map((group) => (
        <Group key={group.kind} group={group} />
      ))}
    </div>
  );
}
