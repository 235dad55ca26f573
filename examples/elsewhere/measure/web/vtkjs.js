// bundled by esbuild, as web.py says
import '@kitware/vtk.js/Rendering/Profiles/Geometry'
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor'
import vtkLight from '@kitware/vtk.js/Rendering/Core/Light'
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper'
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer'
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow'
import vtkSphereSource from '@kitware/vtk.js/Filters/Sources/SphereSource'
import vtkView from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow'
export default async function draw(c, size) {
    const m = c.material
    const source = vtkSphereSource.newInstance({ radius: 1, thetaResolution: 360, phiResolution: 180 })
    const mapper = vtkMapper.newInstance()
    mapper.setInputConnection(source.getOutputPort())
    const actor = vtkActor.newInstance()
    actor.setMapper(mapper)
    const p = actor.getProperty()
    p.setColor(...m.color)
    p.setSpecularColor(...m.specular_color)
    p.setAmbient(m.ambient); p.setDiffuse(m.diffuse); p.setSpecular(m.specular); p.setSpecularPower(m.power)
    p.setInterpolationToPhong()
    const scene = vtkRenderer.newInstance({ automaticLightCreation: false, twoSidedLighting: true })
    scene.setAutomaticLightCreation(false)
    actor.rotateX(90)
    scene.addActor(actor)
    for (const l of c.lamps) {
        const light = vtkLight.newInstance()
        light.setLightTypeToSceneLight()
        light.setPositional(l.at[3] !== 0)
        if (l.at[3] === 0) light.setPosition(...l.at.slice(0, 3).map(x => 100 * x))
        else light.setPosition(...l.at.slice(0, 3))
        light.setFocalPoint(...(l.aim ? l.at.slice(0, 3).map((x, i) => x + l.aim[i]) : [0, 0, 0]))
        if (l.cone) light.setConeAngle(l.cone)
        if (l.exponent !== undefined) light.setExponent(l.exponent)
        if (l.attenuation) light.setAttenuationValues(...l.attenuation)
        scene.addLight(light)
    }
    const camera = scene.getActiveCamera()
    camera.setPosition(0, 0, 5); camera.setFocalPoint(0, 0, 0); camera.setViewUp(0, 1, 0)
    camera.setViewAngle(30); camera.setParallelProjection(c.parallel); camera.setParallelScale(1.25)
    camera.setClippingRange(1, 10)
    const window_ = vtkRenderWindow.newInstance()
    window_.addRenderer(scene)
    const view = vtkView.newInstance()
    view.setSize(size, size)
    window_.addView(view)
    const place = document.getElementById('place')
    place.innerHTML = ''
    view.setContainer(place)
    window_.render()
    const flat = document.createElement('canvas')
    flat.width = flat.height = size
    const [shot] = window_.captureImages()
    const image = new Image()
    image.src = await shot
    await image.decode()
    flat.getContext('2d').drawImage(image, 0, 0)
    view.delete()
    return flat
}
