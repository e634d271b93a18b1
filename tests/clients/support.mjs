// What the scripts of this folder share.

import fs from 'node:fs';
import path from 'node:path';

const kSkipped = 77;  // ctest lists the test as skipped

export function skip(reason) {
    console.log(`SKIPPED: ${reason}`);
    process.exit(kSkipped);
}

// A package of this folder's package.json; the test is skipped if it was not installed.
export async function packageOrSkip(name) {
    try {
        return await import(name);
    } catch (error) {
        if (error.code !== 'ERR_MODULE_NOT_FOUND')
            throw error;
        return skip(`the npm package ${name} is missing: run 'npm ci' in tests/clients`);
    }
}

// The JSON part of a GLB file.
export function jsonOfGlb(bytes) {
    const length = bytes.readUInt32LE(12);
    return JSON.parse(bytes.toString('utf8', 20, 20 + length));
}

// Copies that EXT_mesh_gpu_instancing places, over all nodes.
export function countInstances(gltf) {
    let count = 0;
    for (const node of gltf.nodes ?? []) {
        const attributes = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
        if (attributes)
            count += gltf.accessors[Object.values(attributes)[0]].count;
    }
    return count;
}

export function readExpected(folder) {
    return JSON.parse(fs.readFileSync(path.join(folder, 'expected.json'), 'utf8'));
}

// Collects what is wrong and ends the process with it.
export class Report {
    #failures = 0;

    expect(holds, text) {
        console.log(`${holds ? 'ok  ' : 'FAIL'} ${text}`);
        if (!holds)
            ++this.#failures;
    }

    finish() {
        process.exit(this.#failures === 0 ? 0 : 1);
    }
}
