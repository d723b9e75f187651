// SPDX-License-Identifier: MIT
import { session } from '../state/session';
import './report_notes.css';

/** So many paragraphs are shown, the others on demand: the figures below are to be seen. */
const AT_ONCE = 2;

function Paragraphs({ of }: { of: readonly string[] }) {
  return (
    <>
      {of.map((note) => (
        <p key={note}>{note}</p>
      ))}
    </>
  );
}

/** What whoever made the report has to say, and what the file does not hold; nothing if the page is no report. */
export function ReportNotes() {
  const report = session.value?.report;
  if (!report) return null;
  return (
    <section class="report-notes">
      <h2>{report.title}</h2>
      <Paragraphs of={report.notes.slice(0, AT_ONCE)} />
      {report.notes.length > AT_ONCE && (
        <details>
          <summary>Read on</summary>
          <Paragraphs of={report.notes.slice(AT_ONCE)} />
        </details>
      )}
      {report.leftOut.length > 0 && (
        <details>
          <summary>What this report leaves out</summary>
          <ul>
            {report.leftOut.map((sentence) => (
              <li key={sentence}>{sentence}</li>
            ))}
          </ul>
        </details>
      )}
      <p class="made">Made by strut {session.value?.version}.</p>
    </section>
  );
}
