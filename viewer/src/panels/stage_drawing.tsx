// SPDX-License-Identifier: MIT
// How much of the stage is drawn: everything, less where the machine draws slowly, or as a person chooses.
import { DRAWING_CHOICES, type DrawingChoice, drawingChoice, drawingLevel } from '../scene/drawing';
import { leftOut } from '../scene/drawing_level';

export function StageDrawing() {
  const missing = leftOut(drawingLevel.value);
  const hint = missing.length > 0 ? `Left out, to draw faster: ${missing.join(', ')}` : 'Nothing is left out';
  const isLighter = drawingChoice.value === 'automatic' && drawingLevel.value > 0;
  return (
    <label class="drawing-choice" title={hint}>
      Drawing:
      <select
        value={drawingChoice.value}
        aria-description={hint}
        onChange={(event) => {
          drawingChoice.value = event.currentTarget.value as DrawingChoice;
        }}
      >
        {DRAWING_CHOICES.map((choice) => (
          <option key={choice} value={choice}>
            {choice === 'automatic' && isLighter ? 'automatic (lighter)' : choice}
          </option>
        ))}
      </select>
    </label>
  );
}
