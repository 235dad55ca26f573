#!/bin/sh
# seen.js 0.2.7: its Phong shader raises .5 + R.V, up to 1.5, to specularExponent: a highlight of exponent 15, the default, is
# 292 times as strong in its middle as one of exponent 1.
# Most would guess R.V, at most 1, for which a larger exponent never brightens a highlight.
T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT
command -v npm >/dev/null && npm install --silent --no-audit --no-fund --prefix "$T" seen@0.2.7 >/dev/null 2>&1 || exit 77
node -e "
const seen = require('$T/node_modules/seen/dist/latest/seen.js')
const lit = (exponent, degrees) => {
    const material = new seen.Material(new seen.Color(255, 255, 255), { specularColor: new seen.Color(255, 255, 255), specularExponent: exponent })
    const lamp = seen.Lights.directional({ normal: seen.P(0, 0, 1), intensity: .0001, color: new seen.Color(255, 255, 255) })
    lamp.render()
    const a = degrees * Math.PI / 180, normal = seen.P(Math.sin(a), 0, Math.cos(a))
    return seen.Shaders.phong().shade([lamp], { normal, barycenter: normal }, material).r - 255 * .0255 * Math.cos(a)
}
const one = lit(1, 0), fifteen = lit(15, 0)
console.log('seen.js 0.2.7, highlight where R.V is 1: exponent 1', one.toFixed(4), 'exponent 15', fifteen.toFixed(4))
process.exit(Math.abs(fifteen / one - 1.5 ** 14) < 1 ? 0 : 1)"
