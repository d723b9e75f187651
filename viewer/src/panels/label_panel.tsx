// SPDX-License-Identifier: MIT
export function LabelPanel() {
  return null;
}
