// SPDX-License-Identifier: MIT
// The file that the page is: a report, whose <script id="report"> holds everything. Written by cli/view/report.cpp.
import { Clip } from './clip';
import { type Container, readContainer } from './container';
import { type Alignment, type Source, SourceError } from './source';
import type { AlignmentHeader, ClipHeader, SessionInfo } from './types';

/** What the element holds; containers in base64, by the clip's id. */
export interface Report {
  session: SessionInfo;
  clips: Record<string, string>;
  /** The curves of a clip in one container, by their names. */
  curves: Record<string, string>;
  /** To the first clip. */
  alignments: Record<string, string>;
}

function bytesOf(base64: string): ArrayBuffer {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

/** `around` [frames][points][3] is relative to `path` [frames][3]; the two are added in place. */
function addPath(around: Float32Array, path: Float32Array, numPoints: number): Float32Array {
  for (let i = 0; i < around.length; ++i) {
    around[i]! += path[3 * Math.floor(i / (3 * numPoints)) + (i % 3)]!;
  }
  return around;
}

export class ReportSource implements Source {
  private readonly report: Report;
  /** Read when first asked for. */
  private readonly curves = new Map<string, Container<object>>();

  constructor(report: Report) {
    this.report = report;
  }

  async session(): Promise<SessionInfo> {
    return this.report.session;
  }

  async clip(id: string): Promise<Clip> {
    const { header, arrays } = this.container<ClipHeader>(this.report.clips, id);
    const { aroundPelvis, pelvisPath } = arrays;
    if (aroundPelvis && pelvisPath) arrays.positions = addPath(aroundPelvis, pelvisPath, header.points.length);
    return new Clip({ header, arrays });
  }

  async curve(clip: string, name: string): Promise<Float32Array> {
    const known = this.curves.get(clip) ?? this.container(this.report.curves, clip);
    this.curves.set(clip, known);
    const values = known.arrays[name];
    if (!values) throw new SourceError({ message: `The report does not hold the curve ${name}.` });
    return values;
  }

  async alignment(reference: string, clip: string): Promise<Alignment> {
    if (reference !== this.report.session.files[0]?.id) {
      throw new SourceError({ message: 'The report holds alignments with its first clip only.' });
    }
    const { header, arrays } = this.container<AlignmentHeader>(this.report.alignments, clip);
    return { ...header, moments: arrays.moments ?? new Float32Array() };
  }

  private container<Header>(of: Record<string, string>, id: string): Container<Header> {
    const base64 = of[id];
    if (base64 === undefined) throw new SourceError({ message: 'The report does not hold this.' });
    return readContainer<Header>(bytesOf(base64));
  }
}

/** The report that the page is; none if the program serves the page. */
export function reportOf(page: Document): Report | null {
  return JSON.parse(page.getElementById('report')?.textContent ?? 'null') as Report | null;
}
