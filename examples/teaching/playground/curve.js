// curve.js - brightness along a line: the row of the picture through the marked point, drawn again by
// the module term by term, as areas on top of each other.

function showCurve(answer) {
    const on = S.curve && !S.view, svg = $('#curve');
    svg.classList.toggle('shown', !!on);
    if (!on) return;
    const { width, height } = canvas, across = canvas.clientWidth, tall = canvas.clientHeight;
    const fraction = pointed ? pointed[1] : answer.hit ? answer.point[1] / height : 0.5;
    const row = limit(Math.floor(fraction * height), 0, height - 1), used = usedTerms();
    const sums = [new Float32Array(width)];
    for (let i = 0; i < 4; i++) {
        const sum = Float32Array.from(sums[i]);
        if (used >> i & 1) {
            const add = floats(wasm.page_row(row, 1 << i), width);
            for (let x = 0; x < width; x++) sum[x] += add[x];
        }
        sums.push(sum);
    }
    // 1, which is the most that a screen shows, stands at a quarter of the picture's height
    const most = Math.max(1, ...sums[4]), unit = 0.25 * tall / most, floor = tall - 1;
    const path = sum => Array.from({ length: across }, (_, x) =>
        `${x},${(floor - unit * sum[Math.min(width - 1, Math.floor((x + 0.5) * width / across))])
            .toFixed(1)}`);
    const paths = sums.map(path), y = (fraction * tall).toFixed(1), one = (floor - unit).toFixed(1);
    svg.setAttribute('viewBox', `0 0 ${across} ${tall}`);
    svg.innerHTML = [...'eads'].map((css, i) => used >> i & 1
        ? `<polygon class="${css}" points="${paths[i + 1].join(' ')} ` +
            `${paths[i].reverse().join(' ')}"/>` : '').join('') +
        `<polyline points="${path(sums[4]).join(' ')}"/>` +
        `<line class="row" x2="${across}" y1="${y}" y2="${y}"/>` +
        `<line class="one" x2="${across}" y1="${one}" y2="${one}"/>` +
        `<text x="4" y="${one - 4}">1</text>`;
}
