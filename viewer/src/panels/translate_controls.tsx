// SPDX-License-Identifier: MIT
// The controls of the style: how much of it, where on the body, and what becomes of feet, timing and unfamiliar motion.
import { isOn, numberOf, type SwitchInfo, withValue } from '../translate/controls';
import { change, controls, settings } from '../translate/translating';
import { wordsOf } from '../translate/words';
import { TranslateNumber } from './translate_number';

/** From top to bottom, as the body is. */
const PARTS = ['head', 'trunk', 'left_arm', 'right_arm', 'left_leg', 'right_leg'];

function Switch({ info }: { info: SwitchInfo }) {
  const { title, hint } = wordsOf(info.name);
  return (
    <label title={hint}>
      <input
        type="checkbox"
        checked={isOn(settings.value, info)}
        onChange={(event) => change(withValue(settings.peek(), info, event.currentTarget.checked), info.name)}
      />
      {title}
    </label>
  );
}

function Switches({ names }: { names: readonly string[] }) {
  const found = controls.value!.switches.filter((info) => names.includes(info.name));
  return (
    <>
      {found.map((info) => (
        <Switch key={info.name} info={info} />
      ))}
    </>
  );
}

function Numbers({ group, isUsed = true }: { group: string; isUsed?: boolean }) {
  const place = (name: string) => PARTS.indexOf(name);
  const found = controls.value!.numbers.filter((info) => info.group === group);
  const sorted = [...found].sort((a, b) => place(a.name) - place(b.name));
  return (
    <fieldset disabled={!isUsed}>
      {sorted.map((info) => (
        <TranslateNumber
          key={info.name}
          info={info}
          value={numberOf(settings.value, info)}
          change={(value) => change(withValue(settings.peek(), info, value), info.name)}
        />
      ))}
    </fieldset>
  );
}

/** Everything as usual again; the clip and the models stay. */
function ResetAll() {
  return (
    <button
      type="button"
      disabled={Object.keys(settings.value.values).length === 0}
      onClick={() => change({ ...settings.peek(), values: {} }, 'all')}
    >
      All as usual
    </button>
  );
}

export function TranslateControls() {
  if (!controls.value) return null;
  return (
    <section class="part">
      <h2>Style</h2>
      <Numbers group="style" />
      <details>
        <summary>Parts of the body</summary>
        <Numbers group="parts" />
      </details>
      <Switches names={['retime', 'cleanFeet']} />
      <details>
        <summary>Unfamiliar motion, start, file</summary>
        <Switches names={['generalization']} />
        <Numbers group="generalization" isUsed={settings.value.values.generalization !== false} />
        <Numbers group="start" />
        <Switches names={['keepLayout']} />
      </details>
      <ResetAll />
    </section>
  );
}
