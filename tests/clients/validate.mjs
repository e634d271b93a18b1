// usage: node validate.mjs FOLDER
// The Khronos validator must have no error and no warning on any GLB file of the folder. It does
// not know EXT_mesh_gpu_instancing; `scree check` looks at that.

import fs from 'node:fs';
import path from 'node:path';
import {packageOrSkip, Report} from './support.mjs';

const folder = process.argv[2];
const {default: validator} = await packageOrSkip('gltf-validator');
const report = new Report();

const files = fs.readdirSync(folder, {recursive: true}).filter((name) => name.endsWith('.glb'));
report.expect(files.length > 0, `${files.length} files found`);
for (const name of files.sort()) {
    const bytes = new Uint8Array(fs.readFileSync(path.join(folder, name)));
    const {issues, info} = await validator.validateBytes(bytes, {uri: name, maxIssues: 0});
    report.expect(issues.numErrors === 0 && issues.numWarnings === 0,
        `${name}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ` +
        `${info.totalVertexCount} vertices, ${info.totalTriangleCount} triangles`);
    for (const issue of issues.messages.filter(({severity}) => severity < 2).slice(0, 5))
        console.log(`     ${issue.code} at ${issue.pointer}: ${issue.message}`);
}
report.finish();
