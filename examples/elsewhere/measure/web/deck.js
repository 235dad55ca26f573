// bundled by esbuild, as web.py says
import { Deck, View, Viewport, LightingEffect, AmbientLight, DirectionalLight, PointLight, COORDINATE_SYSTEM } from '@deck.gl/core'
import { SimpleMeshLayer } from '@deck.gl/mesh-layers'
import { SphereGeometry } from '@luma.gl/engine'
class Camera extends View { getViewportType() { return Viewport } get ControllerType() { return null } }
const bytes = v => v.map(x => 255 * x)
export default async function draw(c, size) {
    const m = c.material, canvas = document.createElement('canvas')
    canvas.width = canvas.height = size
    document.getElementById('place').replaceChildren(canvas)
    const lights = { ambient: new AmbientLight({ color: [255, 255, 255], intensity: 1 }) }
    for (const [i, l] of c.lamps.entries())
        lights[`l${i}`] = l.at[3] === 0
            ? new DirectionalLight({ color: bytes(l.color || [1, 1, 1]), intensity: 1, direction: l.at.slice(0, 3).map(x => -x) })
            : new PointLight({ color: bytes(l.color || [1, 1, 1]), intensity: 1, position: l.at.slice(0, 3), attenuation: l.attenuation || [1, 0, 0] })
    const half = c.parallel ? Math.atan(1.25 / 5) : Math.PI / 12
    let deck
    await new Promise((done, fail) => {
        deck = new Deck({
            canvas, width: size, height: size, useDevicePixels: false, controller: false,
            deviceProps: { type: 'webgl', webgl: { antialias: false, preserveDrawingBuffer: true } },
            views: new Camera({ id: 'v', viewMatrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1], orthographic: c.parallel, focalDistance: 5, fovy: half * 360 / Math.PI, near: 1, far: 10 }),
            initialViewState: { v: {} },
            effects: [new LightingEffect(lights)],
            layers: [new SimpleMeshLayer({
                id: 'ball', data: [0], coordinateSystem: COORDINATE_SYSTEM.CARTESIAN, mesh: new SphereGeometry({ nlat: 180, nlong: 360, radius: 1 }),
                getPosition: () => [0, 0, 0], getColor: () => bytes(m.color), parameters: { cullMode: 'none' },
                material: { ambient: m.ambient, diffuse: m.diffuse, shininess: m.shininess, specularColor: bytes(m.specularColor) }
            })],
            onError: fail, onAfterRender: () => deck && deck.layerManager && deck.layerManager.getLayers().every(l => l.isLoaded) && setTimeout(done, 300)
        })
    })
    deck.redraw('measure')
    const flat = document.createElement('canvas')
    flat.width = flat.height = size
    flat.getContext('2d').drawImage(canvas, 0, 0, size, size)
    deck.finalize()
    return flat
}
