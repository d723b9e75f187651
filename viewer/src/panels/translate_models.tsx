// SPDX-License-Identifier: MIT
// Which clip is translated by which models: one, or several with a share each; and what they were learnt from.
import { nameOf } from '../state/names';
import { loadClip } from '../state/session';
import { withModel, withOtherModel, withoutModel, withShare } from '../translate/controls';
import { change, clipFiles, modelFiles, models, settings, tellProblem, truth } from '../translate/translating';
import { filesInShort } from '../translate/words';
import { Icon } from '../ui/icon';

const PERCENT = 100;

function Chooser(props: {
  label: string;
  value: string;
  choices: readonly { id: string; name: string }[];
  choose: (id: string) => void;
}) {
  return (
    <select value={props.value} aria-label={props.label} onChange={(event) => props.choose(event.currentTarget.value)}>
      {props.choices.map(({ id, name }) => (
        <option key={id} value={id}>
          {name}
        </option>
      ))}
    </select>
  );
}

function inShort({ id }: { id: string }) {
  return { id, name: nameOf(id) };
}

function ModelFacts({ id }: { id: string }) {
  const info = models.value.get(id);
  if (!info) return null;
  const from = filesInShort(info.provenance, 'inputs');
  const to = filesInShort(info.provenance, 'outputs');
  return (
    <p class="hint">
      {from && to && `From ${from} to ${to}. `}
      {info.num_joints} joints, {info.frame_rate} frames/s, {info.tells_footplants ? 'tells' : 'does not tell'}{' '}
      footplants.
    </p>
  );
}

function Share({ index }: { index: number }) {
  const { id, share } = settings.value.models[index]!;
  const percent = `${Math.round(PERCENT * share)} %`;
  if (index === 0) return <p class="hint share">has the rest: {percent}</p>;
  const set = (to: number) => {
    const now = settings.peek();
    change({ ...now, models: withShare(now.models, id, to) }, `share ${id}`);
  };
  return (
    <p class="share">
      <input
        type="range"
        min={0}
        max={1}
        step={0.01}
        value={share}
        aria-label="Share of the blend"
        aria-valuetext={percent}
        onInput={(event) => set(Number(event.currentTarget.value))}
      />
      <output>{percent}</output>
    </p>
  );
}

function Model({ index }: { index: number }) {
  const chosen = settings.value.models;
  const { id } = chosen[index]!;
  const taken = new Set(chosen.map((model) => model.id));
  const choices = modelFiles.value.filter((file) => file.id === id || !taken.has(file.id));
  const set = (next: typeof chosen) => change({ ...settings.peek(), models: next }, 'models');
  return (
    <li>
      <div class="chosen">
        <Chooser
          label={index === 0 ? 'Model' : `Model ${index + 1}`}
          value={id}
          choices={choices}
          choose={(to) => set(withOtherModel(chosen, index, to))}
        />
        {chosen.length > 1 && (
          <button
            type="button"
            class="plain"
            aria-label="Take the model out of the blend"
            title="Take it out of the blend"
            onClick={() => set(withoutModel(chosen, id))}
          >
            <Icon name="close" />
          </button>
        )}
      </div>
      {chosen.length > 1 && <Share index={index} />}
      <ModelFacts id={id} />
    </li>
  );
}

function AddModel() {
  const { models: chosen } = settings.value;
  const next = modelFiles.value.find((file) => !chosen.some((model) => model.id === file.id));
  if (!next) return null;
  const add = () => change({ ...settings.peek(), models: withModel(chosen, next.id) }, 'models');
  return (
    <button type="button" onClick={add}>
      Blend another model
    </button>
  );
}

function Truth() {
  const choose = async (id: string) => {
    try {
      if (id !== '') await loadClip(id);
      truth.value = id;
    } catch (error) {
      tellProblem(error);
    }
  };
  const choices = [
    { id: '', name: 'nothing' },
    ...clipFiles.value.filter(({ id }) => id !== settings.value.clip).map(inShort),
  ];
  if (choices.length === 1) return null;
  return (
    // biome-ignore lint/a11y/noLabelWithoutControl: the control is a component
    <label class="field">
      <span>Compare with</span>
      <Chooser label="Compare with" value={truth.value} choices={choices} choose={(id) => void choose(id)} />
    </label>
  );
}

export function TranslateModels() {
  const { clip, models: chosen } = settings.value;
  return (
    <section class="part">
      {/* biome-ignore lint/a11y/noLabelWithoutControl: the control is a component */}
      <label class="field">
        <span>Clip</span>
        <Chooser
          label="Clip"
          value={clip}
          choices={clipFiles.value.map(inShort)}
          choose={(id) => change({ ...settings.peek(), clip: id }, 'clip')}
        />
      </label>
      <ul class="translate-models" aria-label="Models">
        {chosen.map(({ id }, i) => (
          <Model key={id} index={i} />
        ))}
      </ul>
      <AddModel />
      <Truth />
    </section>
  );
}
