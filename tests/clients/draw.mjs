// usage: node draw.mjs FOLDER
// three.js in headless Chromium draws the files of expected.json. Seen straight from above without
// light they must cover the same pixels as our own bake of the same scene and show the photograph
// at its place; the numbers of meshes, copies and drawn triangles must be right. Pictures for
// people are left beside the files as *.three.png.

import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {packageOrSkip, readExpected, Report, skip} from './support.mjs';

const kHere = path.dirname(fileURLToPath(import.meta.url));
const kTypes = {'.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary'};
const kArguments = [
    '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--disable-quic', '--disable-dev-shm-usage',
    '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1',
];

function findChromium() {
    const candidates = [process.env.SCREE_CHROMIUM, '/usr/bin/chromium',
        '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
    return candidates.find((file) => file && fs.existsSync(file)) ??
        skip('no Chromium found: install Debian\'s chromium or set SCREE_CHROMIUM');
}

// Serves this folder, three.js and the assets to this machine alone.
function serve(assets) {
    const roots = {three: path.join(kHere, 'node_modules', 'three'), assets, page: kHere};
    const server = http.createServer((request, response) => {
        const [, root, ...rest] = decodeURIComponent(request.url).split('/');
        const file = path.join(roots[root] ?? kHere, ...rest);
        if (!roots[root] || rest.includes('..') || !fs.existsSync(file)) {
            response.writeHead(root === 'favicon.ico' ? 204 : 404).end();
            return;
        }
        response.writeHead(200, {'content-type': kTypes[path.extname(file)] ?? 'text/plain'});
        fs.createReadStream(file).pipe(response);
    });
    return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

// Compare the picture from above with the mask of our own bake and with the photograph.
function compare(rgba, view, mask, photo) {
    let both = 0, either = 0, difference = 0;
    for (let y = 0; y < view.height; ++y)
        for (let x = 0; x < view.width; ++x) {
            const at = 4 * ((view.height - 1 - y) * view.width + x);  // bottom row first
            const [r, g, b] = rgba.subarray(at, at + 3);
            const k = y * view.width + x;
            const drawn = !(r === 0 && g === 0 && b === 255);
            const wanted = mask[k] !== 0;
            either += drawn || wanted ? 1 : 0;
            if (drawn && wanted) {
                ++both;
                if (photo)
                    difference += (Math.abs(r - photo[3 * k]) + Math.abs(g - photo[3 * k + 1]) +
                        Math.abs(b - photo[3 * k + 2])) / 3;
            }
        }
    return {overlap: both / Math.max(either, 1), difference: difference / Math.max(both, 1),
        coverage: both / (view.width * view.height)};
}

async function check(page, name, expected, folder, report) {
    const {view} = expected;
    const seen = await page.evaluate(([url, v]) => window.drawFromAbove(url, v),
        [`/assets/${name}`, view]);
    const read = (file) => fs.readFileSync(path.join(folder, file));
    for (const what of ['meshes', 'instances', 'triangles'].filter((key) => key in expected))
        report.expect(seen[what] === expected[what],
            `${name}: ${seen[what]} of ${expected[what]} ${what} drawn`);
    report.expect(seen.textured === seen.meshes, `${name}: every mesh has the photograph`);
    await page.evaluate(([url, v]) => window.drawOblique(url, v),
        [`/assets/${name}`, {width: 800, height: 600, across: view.across}]);
    await page.screenshot({path: path.join(folder, name.replace('.glb', '.three.png'))});
    if (!expected.mask)
        return;
    const {overlap, difference, coverage} = compare(Buffer.from(seen.rgba, 'base64'), view,
        read(expected.mask), expected.photo ? read(expected.photo) : undefined);
    report.expect(coverage > 0.02, `${name}: ${(100 * coverage).toFixed(1)} % of the view is stone`);
    report.expect(overlap > 0.97, `${name}: overlap with our own bake is ${overlap.toFixed(4)}`);
    report.expect(difference < 12,
        `${name}: colours are ${difference.toFixed(1)} of 255 off the photograph`);
}

const folder = path.resolve(process.argv[2]);
const {chromium} = await packageOrSkip('playwright-core');
await packageOrSkip('three');
const executablePath = findChromium();
const report = new Report();
const server = await serve(folder);
const browser = await chromium.launch({executablePath, args: kArguments, timeout: 60000});
try {
    const page = await browser.newPage({viewport: {width: 800, height: 600}});
    page.setDefaultTimeout(90000);
    page.on('pageerror', (error) => report.expect(false, `page: ${error.message}`));
    page.on('console', (message) => {
        if (message.type() === 'error')
            report.expect(false, `console: ${message.text()}`);
    });
    await page.goto(`http://127.0.0.1:${server.address().port}/page/view.html`);
    await page.waitForFunction('window.ready === true');
    for (const [name, expected] of Object.entries(readExpected(folder)))
        await check(page, name, expected, folder, report);
} finally {
    await browser.close();
    server.close();
}
report.finish();
