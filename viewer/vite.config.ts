// SPDX-License-Identifier: MIT
// Builds the page into one file, built/strut.html, which the program carries: no other file, no network. What the page
// may load and run is said in it (Content-Security-Policy), by the hash of its own script.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { defineConfig, type Plugin } from 'vite';

/** What the page contains of others, with their licences: all MIT, which asks for its text to go along. */
const LICENCES = Object.keys(JSON.parse(readFileSync('package.json', 'utf8')).dependencies)
  .map((name) => `${name}\n\n${readFileSync(`node_modules/${name}/LICENSE`, 'utf8').trim()}`)
  .join('\n\n')
  .replaceAll('--', '- -');

/** Moves script and style into the HTML, so that there is one file. */
function singleFile(): Plugin {
  return {
    name: 'single-file',
    enforce: 'post',
    generateBundle(_, bundle) {
      let script = '';
      let style = '';
      for (const [name, file] of Object.entries(bundle)) {
        if (file.type === 'chunk') script += file.code;
        else if (name.endsWith('.css')) style += file.source;
        if (name.endsWith('.js') || name.endsWith('.css')) delete bundle[name];
      }
      const page = Object.values(bundle).find((file) => file.fileName === 'index.html');
      if (page?.type !== 'asset') throw new Error('index.html was not built');
      // What would end the script element early stands in strings only, where the escape means the same.
      script = script.trim().replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
      const hash = createHash('sha256').update(script).digest('base64');
      const policy = [
        "default-src 'none'",
        `script-src 'sha256-${hash}'`,
        "style-src 'unsafe-inline'",
        "connect-src 'self'",
        'img-src data: blob:',
        "base-uri 'none'",
        "form-action 'none'",
      ].join('; ');
      page.fileName = 'strut.html';
      page.source = String(page.source)
        .replace(/\s*<script\b[^>]*src=[^>]*><\/script>/g, '')
        .replace(/\s*<link\b[^>]*stylesheet[^>]*>/g, '')
        .replace('<!-- policy -->', () => `<meta http-equiv="Content-Security-Policy" content="${policy}">`)
        .replace('<!-- style -->', () => `<style>${style.trim()}</style>`)
        .replace('<!-- script -->', () => `<script type="module">${script}</script>`)
        .replace('</html>', () => `</html>\n<!--\nThis page contains:\n\n${LICENCES}\n-->`);
    },
  };
}

export default defineConfig({
  build: { outDir: 'built', target: 'es2022', modulePreload: false, cssCodeSplit: false, assetsInlineLimit: 1e6 },
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  plugins: [singleFile()],
});
