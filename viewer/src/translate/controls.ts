// SPDX-License-Identifier: MIT
// What a person has set: the clip, the models with their shares, the controls. As strut translate has it, the first model
// has what the shares of the others leave. What controls there are, their ranges and usual values the program tells.

export interface NumberInfo {
  name: string;
  /** Under which heading it stands: style, parts, generalization, start. */
  group: string;
  least: number;
  greatest: number;
  usual: number;
}

export interface SwitchInfo {
  name: string;
  usual: boolean;
}

/** The answer to translate/controls. */
export interface ControlsInfo {
  numbers: readonly NumberInfo[];
  switches: readonly SwitchInfo[];
}

export interface ModelShare {
  id: string;
  /** 0 to 1; of the first model what the others leave. */
  share: number;
}

export interface Settings {
  clip: string;
  models: readonly ModelShare[];
  /** By name, only what is not as usual. */
  values: Readonly<Record<string, number | boolean>>;
}

/** Shares are set in steps of this, so that they are short to write. */
const SHARE_STEPS = 1000;
const rounded = (share: number) => Math.round(share * SHARE_STEPS) / SHARE_STEPS;

function withRest([first, ...others]: readonly ModelShare[]): ModelShare[] {
  if (!first) return [];
  const taken = others.reduce((sum, { share }) => sum + share, 0);
  return [{ id: first.id, share: Math.max(0, rounded(1 - taken)) }, ...others];
}

/** Gives the model `id` a share. The first one has the rest; where there is not enough of it the others give way, in
 *  the proportions they have. */
export function withShare(models: readonly ModelShare[], id: string, wanted: number): ModelShare[] {
  const [first, ...others] = models;
  if (!first || id === first.id) return [...models];
  const share = rounded(Math.min(Math.max(wanted, 0), 1));
  const taken = others.reduce((sum, model) => sum + (model.id === id ? 0 : model.share), 0);
  const squeeze = taken > 1 - share ? (1 - share) / taken : 1;
  // Rounded down, so that all together are never more than 1.
  const squeezed = (own: number) => (squeeze === 1 ? own : Math.floor(own * squeeze * SHARE_STEPS) / SHARE_STEPS);
  return withRest([first, ...others.map((m) => ({ id: m.id, share: m.id === id ? share : squeezed(m.share) }))]);
}

/** Adds a model, with as much as every other has; a model that is there already stays as it is. */
export function withModel(models: readonly ModelShare[], id: string): ModelShare[] {
  if (models.some((model) => model.id === id)) return [...models];
  return withShare([...models, { id, share: 0 }], id, models.length === 0 ? 1 : 1 / (models.length + 1));
}

export function withoutModel(models: readonly ModelShare[], id: string): ModelShare[] {
  return withRest(models.filter((model) => model.id !== id));
}

/** Puts `id` in place of the model number `index`. */
export function withOtherModel(models: readonly ModelShare[], index: number, id: string): ModelShare[] {
  return models.map((model, i) => (i === index ? { ...model, id } : model));
}

/** Sets a control; one that is as usual is left out. */
export function withValue(settings: Settings, info: NumberInfo | SwitchInfo, value: number | boolean): Settings {
  const { [info.name]: _, ...others } = settings.values;
  return { ...settings, values: value === info.usual ? others : { ...others, [info.name]: value } };
}

export function numberOf(settings: Settings, info: NumberInfo): number {
  return (settings.values[info.name] as number | undefined) ?? info.usual;
}

export function isOn(settings: Settings, info: SwitchInfo): boolean {
  return (settings.values[info.name] as boolean | undefined) ?? info.usual;
}

/** What the program is asked. */
export function bodyOf({ clip, models, values }: Settings): Record<string, unknown> {
  const [first, ...others] = models;
  return { clip, models: [{ id: first?.id }, ...others], ...values };
}
