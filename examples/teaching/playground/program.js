// program.js - the C program that draws what the page shows, to the bit.

function program() {
    const [width, height] = size(finest()), { distance, near, far } = camera(width, height);
    const [x, y, z, radius, tall] = bounds(), scale = scaleOf(radius);
    const lit = !S.view, room = S.room && lit, compare = S.compare && lit, tab = compare ? '        ' : '    ';
    const f = v => Number.isInteger(v) ? String(v) : v + 'f';
    const list = (...v) => v.flat().map(f).join(', '), v3 = (...v) => `shade_v3(${list(...v)})`;
    const name = prefix => n => `SHADE_${prefix}_${n.toUpperCase().replace(/ /g, '_')}`;
    const bits = (prefix, names, set) =>
        names.filter((_, i) => set >> i & 1).map(name(prefix)).join(' |\n        ');
    const model = ['Blinn Phong', 'Phong', 'Lambert', 'ambient', 'emissive', 'cool to warm'];
    const flag = ['two sided', 'two sided abs', 'ungated specular', 'weighted specular',
        'attenuated ambient', 'infinite viewer'];
    const shading = ['per fragment', 'per vertex', 'per face'];
    const file = JSON.stringify(fileName.replace(/[^\x20-\x7e]/g, '_'));
    const on = LAMPS.filter(j => S['on' + j]);

    const lamp = (j, i) => {
        const of = field => S[field + j], at = `    lamps[${i}]`;
        return [
            of('beta') < 180
                ? `${at} = shade_spot_light(${v3(of('p'))}, ${v3(of('p').map(v => 0 - v))},\n` +
                  `                                ${f(of('beta'))} * 0.017453292f, ` +
                  `${f(of('e'))}, ${v3(of('I'))});`
                : `${at} = shade_point_light(${v3(of('p'))}, ${v3(of('I'))});`,
            of('far') && `${at}.position.w = 0;                          /* at infinity */`,
            Math.max(...of('A')) > 0 && `${at}.ambient = ${v3(of('A'))};`,
            `${at}.constant = ${f(of('a'))}, lamps[${i}].linear = ${f(of('b'))};`,
            `${at}.quadratic = ${f(of('c'))};`];
    };
    const tone = (which, ...rgb) =>
        `    state.lighting.${which} = shade_linear_from_srgb(${v3(rgb)});`;
    const target = compare ? '&panel' : '&target';
    const drawing = [
        room && `${tab}scene_draw_room(${target}, &room.view, state, ${f(S.pitch)}, ` +
            `${f(floorOf(radius, tall))});`,
        lit ? `${tab}shade_draw_mesh(${target}, &mesh.view, &state, NULL);`
            : `${tab}look_draw(${target}, &mesh.view, &state, ${list(near, far)}, ${S.view - 1});`,
        S.wire && `${tab}wire_draw(${target}, wires, wire_count, &state, ` +
            `${f(round(finest()))}, ${v3(ink)});`];

    return [
        '/* beside shade.h and its examples:',
        '   cc -O2 -I. picture.c -lm -o picture && ./picture    writes picture.ppm */',
        '#define SHADE_IMPLEMENTATION',
        '#include "shade.h"',
        '#include "examples/shared/mesh.h"',
        S.shape === 2 && '#include "examples/kit/read/files.h"',
        S.shape === 0 && !room && '#include "examples/shared/shapes.h"',
        (S.shape > 2 || room) && '#include "examples/teaching/playground/scene.h"',
        '',
        `enum { WIDTH = ${width}, HEIGHT = ${height} };`,
        'static uint32_t pixels[WIDTH * HEIGHT];',
        'static float depth[WIDTH * HEIGHT];',
        (!lit || S.wire) &&             // the file without its guard
            LOOK.replace(/^[^]*?#define.*\s*/, '\n').replace(/\s*#endif\s*$/, ''),
        '',
        'int main(void)',
        '{',
        '    shade_target target = { .width = WIDTH, .height = HEIGHT, .color = pixels,',
        '                            .depth = depth, .srgb = 1 };',
        `    shade_material material = { .emission = { ${list(S.ke)} },`,
        `                                .ambient = { ${list(S.ka)} },`,
        `                                .diffuse = { ${list(S.kd)} },`,
        `                                .specular = { ${list(S.ks)} },`,
        `                                .shininess = ${f(S.n)} };`,
        '    shade_draw_state state = { .material = &material };',
        '    shade_light lamps[3];',
        S.wire && '    shade_vec3 *wires;\n    int wire_count;',
        [`    owned_mesh mesh = shape_teapot(${S.detail});`,
            `    owned_mesh mesh = mesh_sphere(${8 * S.detail}, ${4 * S.detail});`,
            '    owned_mesh mesh;\n    char error[300];',
            `    owned_mesh mesh = scene_balls(${S.detail});`,
            `    owned_mesh mesh = scene_ribbon(${S.detail});`][S.shape],
        room && '    owned_mesh room = scene_room();',
        '',
        S.shape === 2 && `    if (mesh_read_file(${file}, &mesh, error, sizeof error))\n` +
            '        return puts(error), 1;',
        ...on.flatMap(lamp),
        `    state.lighting.lights = lamps, state.lighting.light_count = ${on.length};`,
        `    state.lighting.ambient = ${v3(S.Ia)};`,
        `    state.lighting.model = ${name('MODEL')(model[S.model])};`,
        S.model === 5 && tone('cool', 0.4, 0.4, 0.7), S.model === 5 && tone('warm', 0.8, 0.6, 0.6),
        S.flags > 0 && `    state.lighting.flags = ${bits('FLAG', flag, S.flags)};`,
        S.terms < 15 && `    state.lighting.terms = ${bits('TERM', TERMS, S.terms)};`,
        `    state.shading = ${name('SHADING')(shading[S.shading])};`,
        `    state.model = shade_mat4_mul(shade_mat4_rotation(${f(S.pitch)}, shade_v3(1, 0, 0)),`,
        `                                 shade_mat4_rotation(${f(S.yaw)}, shade_v3(0, 1, 0)));`,
        '    state.model = shade_mat4_mul(state.model,',
        `                                 shade_mat4_scaling(${v3(scale, scale, scale)}));`,
        '    state.model = shade_mat4_mul(state.model,',
        `                                 shade_mat4_translation(${v3(-x, -y, -z)}));`,
        `    state.view = shade_mat4_look_at(${v3(0, 0, distance)}, shade_v3(0, 0, 0),`,
        '                                    shade_v3(0, 1, 0));',
        `    state.projection = shade_mat4_perspective(0.5f, WIDTH / ${compare ? '3 / ' : ''}` +
            `(float)HEIGHT, ${list(near, far)});`,
        S.wire && '    wires = wire_points(&mesh.view, &wire_count);',
        `    shade_clear(&target, shade_v4(${list(paper, 1)}), 1);`,
        ...compare ? [
            '    for (int i = 0; i < 3; i++) {    /* Phong, Blinn-Phong, and that with 4 n */',
            '        shade_target panel = target;',
            '        panel.stride = WIDTH, panel.width = WIDTH / 3;',
            '        panel.color = pixels + i * panel.width;',
            '        panel.depth = depth + i * panel.width;',
            '        state.lighting.model = i ? SHADE_MODEL_BLINN_PHONG : SHADE_MODEL_PHONG;',
            '        if (i == 2) material.shininess = shade_blinn_exponent(material.shininess);',
            ...drawing,
            '    }'] : drawing,
        '    return shade_write_ppm("picture.ppm", &target);',
        '}',
        ''].filter(line => typeof line === 'string').join('\n');
}
