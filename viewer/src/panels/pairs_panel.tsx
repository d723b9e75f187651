// SPDX-License-Identifier: MIT
export function PairsPanel() {
  return null;
}
