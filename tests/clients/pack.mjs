// usage: node pack.mjs FOLDER
// gltfpack -mi must read the patches and keep every copy.

import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {spawnSync} from 'node:child_process';
import {fileURLToPath} from 'node:url';
import {countInstances, jsonOfGlb, packageOrSkip, readExpected, Report} from './support.mjs';

const folder = process.argv[2];
await packageOrSkip('gltfpack');
const program = fileURLToPath(new URL('node_modules/gltfpack/cli.js', import.meta.url));
const report = new Report();
const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'scree-pack-'));

for (const [name, expected] of Object.entries(readExpected(folder))) {
    if (expected.instances === 0)
        continue;
    const output = path.join(scratch, name.replaceAll('/', '-'));
    const run = spawnSync(process.execPath,
        [program, '-i', path.join(folder, name), '-o', output, '-mi'],
        {encoding: 'utf8', timeout: 60000});
    report.expect(run.status === 0, `${name}: gltfpack -mi accepts it ${run.stdout}${run.stderr}`);
    if (run.status !== 0)
        continue;
    const bytes = fs.readFileSync(output);
    const kept = countInstances(jsonOfGlb(bytes));
    report.expect(kept === expected.instances,
        `${name}: ${kept} of ${expected.instances} copies kept in ${bytes.length} bytes`);
}
fs.rmSync(scratch, {recursive: true});
report.finish();
