"""VTK 9.1 (Debian: python3-vtk9)"""
import vtkmodules.all as V
from ball import *

def draw(case, size):
    m = case.material
    source = V.vtkSphereSource()
    source.SetRadius(1); source.SetThetaResolution(360); source.SetPhiResolution(180)
    turn = V.vtkTransformPolyDataFilter()
    spin = V.vtkTransform(); spin.RotateX(90)
    turn.SetTransform(spin); turn.SetInputConnection(source.GetOutputPort())
    mapper = V.vtkPolyDataMapper(); mapper.SetInputConnection(turn.GetOutputPort())
    actor = V.vtkActor(); actor.SetMapper(mapper)
    p = actor.GetProperty()
    p.SetColor(m['color']); p.SetSpecularColor(m['specular_color'])
    p.SetAmbient(m['ambient']); p.SetDiffuse(m['diffuse'])
    p.SetSpecular(m['specular']); p.SetSpecularPower(m['power'])
    p.SetInterpolationToPhong()
    scene = V.vtkRenderer(); scene.AddActor(actor); scene.SetAutomaticLightCreation(0)
    for l in case.lamps:
        light = V.vtkLight(); light.SetLightTypeToSceneLight()
        light.SetColor(l.get('color', WHITE))
        at = l['at']
        if at[3] == 0:
            light.SetPositional(0); light.SetPosition([100 * x for x in at[:3]]); light.SetFocalPoint(0, 0, 0)
        else:
            light.SetPositional(1); light.SetPosition(at[:3])
            light.SetFocalPoint([a + b for a, b in zip(at, l['aim'])])
            if 'cone' in l: light.SetConeAngle(l['cone'])
            if 'exponent' in l: light.SetExponent(l['exponent'])
            if 'attenuation' in l: light.SetAttenuationValues(l['attenuation'])
        scene.AddLight(light)
    camera = scene.GetActiveCamera()
    camera.SetPosition(EYE); camera.SetFocalPoint(0, 0, 0); camera.SetViewUp(0, 1, 0)
    camera.SetParallelProjection(case.parallel); camera.SetParallelScale(HALF)
    camera.SetViewAngle(FOVY); camera.SetClippingRange(1, 10)
    window = V.vtkRenderWindow()
    window.SetOffScreenRendering(1); window.SetMultiSamples(0)
    window.SetSize(size, size); window.AddRenderer(scene); window.Render()
    bytes_ = V.vtkUnsignedCharArray()
    window.GetPixelData(0, 0, size - 1, size - 1, 1, bytes_, 0)
    flat = [int(bytes_.GetValue(i)) for i in range(3 * size * size)]
    rows = [flat[3 * size * y:3 * size * (y + 1)] for y in range(size)][::-1]
    return [tuple(r[3 * x:3 * x + 3]) for r in rows for x in range(size)]

materials = [dict(color=ORANGE, specular_color=WHITE, ambient=.1, diffuse=.6, specular=.3, power=10),
             dict(color=WHITE, specular_color=WHITE, ambient=0, diffuse=.6, specular=.8, power=30),
             dict(color=BLUE, specular_color=(1, .8, .6), ambient=.2, diffuse=.7, specular=.5, power=100)]
cases = every(materials, directions())
cases += every(materials[:1], [[dict(at=(2, 1.5, 2.5, 1), aim=(-2, -1.5, -2.5))],
                               [dict(at=(2, 1.5, 2.5, 1), aim=(-2, -1.5, -2.5), cone=15, exponent=20)],
                               [dict(at=(2, 1.5, 2.5, 1), aim=(-1, 0, 0), cone=120, exponent=20, attenuation=(.5, 0, .1))]])
main('vtk', 'VTK 9.1.0 (Debian python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1)', cases, draw, lamp='vtk_lamp',
     ball=Case('parallel', materials[1], [dict(at=KEY)]))
