// SPDX-License-Identifier: MIT
import { type Signal, useSignal } from '@preact/signals';
import type { RefObject } from 'preact';
import { useEffect } from 'preact/hooks';

/** The inner width or height of an element [px], followed as it changes; 0 until it is known. */
export function useSize(of: RefObject<Element | null>, which: 'width' | 'height'): Signal<number> {
  const size = useSignal(0);
  useEffect(() => {
    const watch = new ResizeObserver(([entry]) => {
      size.value = entry!.contentRect[which];
    });
    watch.observe(of.current!);
    return () => watch.disconnect();
  }, [of, which, size]);
  return size;
}
