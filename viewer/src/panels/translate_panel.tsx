// SPDX-License-Identifier: MIT
export function TranslatePanel() {
  return null;
}
