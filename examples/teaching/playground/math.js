// math.js - the page's equations: a little LaTeX becomes MathML, which browsers draw and read aloud.
// Known are letters, numbers, signs, _ ^ { }, \frac, \sqrt, \mathbf, \text, \class{css}{...}, and the
// names of SIGNS.

const SIGNS = { cdot: '·', sum: 'Σ', beta: 'β', alpha: 'α', gamma: 'γ', lambda: 'λ', times: '×',
    ge: '≥', le: '≤', '{': '{', '}': '}' };
const NAMES = ['cos', 'max', 'sin'];
const escapeXml = text => text.replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);

function mathml(tex) {
    const tokens = tex.match(/\\[a-zA-Z]+|\\.|\d*\.?\d+|[^\s]/g) || [];
    let at = 0;
    // the tokens of a group in braces as they stand
    const word = () => {
        let text = '';
        for (at++; tokens[at] !== '}'; at++) text += tokens[at];
        at++;
        return text;
    };
    // the letters of \text{...}, with its spaces, which tokens do not have
    const texts = [...tex.matchAll(/\\text\{([^}]*)\}/g)].map(found => found[1]);
    const group = () => {
        if (tokens[at] !== '{') return atom();
        at++;
        const inside = row('}');
        at++;
        return inside;
    };
    const atom = () => {
        const token = tokens[at++];
        if (token === '\\frac') return `<mfrac>${group()}${group()}</mfrac>`;
        if (token === '\\sqrt') return `<msqrt>${group()}</msqrt>`;
        if (token === '\\mathbf') return `<mi class="bold">${word()}</mi>`;
        if (token === '\\text')
            return word(), `<mtext>${escapeXml(texts.shift().replace(/ /g, '\u00a0'))}</mtext>`;
        if (token === '\\,') return '<mspace width=".17em"></mspace>';
        if (token === '\\quad') return '<mspace width="1em"></mspace>';
        if (token === '\\class') return `<mrow class="${word()}">${group()}</mrow>`;
        if (token[0] === '\\' && NAMES.includes(token.slice(1)))
            return `<mi>${token.slice(1)}</mi>`;
        const sign = token[0] === '\\' ? SIGNS[token.slice(1)] : token;
        if (/^[a-zA-Zα-ω]$/.test(sign)) return `<mi>${sign}</mi>`;
        if (/[\d∞]/.test(sign)) return `<mn>${sign}</mn>`;
        if ('()[]{}|'.includes(sign)) return `<mo stretchy="false">${sign}</mo>`;
        // a sign of a number has no room after it
        const unary = sign === '-' && (at < 2 || /^([(=,]|\\,|\\cdot)$/.test(tokens[at - 2]));
        const form = unary ? ' form="prefix"' : '+-='.includes(sign) ? ' form="infix"' : '';
        return `<mo${form}>${escapeXml(sign === '-' ? '−' : sign)}</mo>`;
    };
    const row = end => {
        let out = '';
        while (at < tokens.length && tokens[at] !== end) {
            const base = atom();
            let low = '', high = '';
            while ('_^'.includes(tokens[at] || ' '))
                if (tokens[at++] === '_') low = group();
                else high = group();
            out += low && high ? `<msubsup>${base}${low}${high}</msubsup>`
                : low ? `<msub>${base}${low}</msub>`
                : high ? `<msup>${base}${high}</msup>` : base;
        }
        return `<mrow>${out}</mrow>`;
    };
    return `<math>${row()}</math>`;
}
