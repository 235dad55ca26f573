// math.js - the page's equations: a little LaTeX becomes MathML, which browsers draw and read aloud.
// Known are letters, numbers, signs, _ ^ { }, \frac, \sqrt, \mathbf, \text, \class{css}{...}, and the
// names of SIGNS.

const SIGNS = { cdot: '·', sum: 'Σ', beta: 'β', alpha: 'α', gamma: 'γ', lambda: 'λ', theta: 'θ', phi: 'φ',
    sigma: 'σ', omega: 'ω', times: '×', ge: '≥', le: '≤', '{': '{', '}': '}' };
const NAMES = ['cos', 'max', 'sin'];
const escapeXml = text => text.replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);

// The letters of a course, which letters= names: those of the page in its letters. I_1 is the light of lamp 1.
const LETTERS = {
    uw: { n: 'n_s', 'I_d,\\,I_s': 'I_L', I_d: 'I_L', I_s: 'I_L', X: 'Q' },
    massey: { n: '\\alpha', N: 'n', L: 'l', V: 'v', R: 'r', H: 'h' },
    shirley: { n: 'p', N: 'n', L: 'l', V: 'e', R: 'r', H: 'h', k_d: 'c_r', k_a: 'c_{ra}', k_s: 'c_p', I_a: 'c_a',
        'I_d,\\,I_s': 'c_l', I_d: 'c_l', I_s: 'c_l', I_1: 'c_{l1}', I_2: 'c_{l2}', I_3: 'c_{l3}', '\\phi': '\\sigma' },
    berkeley: { n: 'p', N: 'n', L: 'l', V: 'v', R: 'r', H: 'h', 'I_d,\\,I_s': 'I', I_d: 'I', I_s: 'I' },
};
let letters = {};
const spell = tex => tex.replace(/(?<=\\mathbf\{)[NLVRH](?=\})|(?<![a-zA-Z\\])(k_[ads]|I_d,\\,I_s|I_[ads123]|[nX])(?![a-zA-Z])|\\phi/g,
    letter => letters[letter] || letter);
const spellC = code => code.replace(/\b(k_[ads]|I_[ads123]|n|X_[123])\b/g, name => name[0] === 'X'
    ? (letters.X || 'X') + name.slice(1) : (letters[name] || name).replace(/[\\{}]/g, ''));
// A letter as text
const bare = tex => spell(tex).replace(/\\mathbf\{(.*)\}/, '$1').replace(/\\([a-z]+)/, (_, name) => SIGNS[name])
    .replace('_s', 'ₛ');

function mathml(written) {
    const tex = spell(written);
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
