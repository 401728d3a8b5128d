#!/usr/bin/env python3
"""Writes an IFC2x3 file of a large office building: walls with window openings, columns as mapped items, slabs.

usage: large_ifc.py STOREYS > FILE.ifc      (each storey: 400 walls, 400 openings, 200 columns, property sets; 1.1 MB)
"""
import sys

storeys = int(sys.argv[1])
out = sys.stdout
number = 100


def line(text):
    global number
    number += 1
    out.write("#%d=%s;\n" % (number, text))
    return number


guids = 0
LETTERS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$"


def guid():
    global guids
    guids += 1
    value, text = guids, ""
    for _ in range(22):
        text = LETTERS[value % 64] + text
        value //= 64
    return text


def point(*xyz):
    return line("IFCCARTESIANPOINT((%s))" % ",".join("%.6f" % v for v in xyz))


def placement(relative_to, x, y, z, direction=(1, 0, 0)):
    axes = line("IFCAXIS2PLACEMENT3D(#%d,#%d,#%d)" % (point(x, y, z), up, xdir if direction == (1, 0, 0) else ydir))
    return line("IFCLOCALPLACEMENT(%s,#%d)" % ("#%d" % relative_to if relative_to else "$", axes))


def shape(kind, item):
    body = line("IFCSHAPEREPRESENTATION(#12,'Body','%s',(#%d))" % (kind, item))
    return line("IFCPRODUCTDEFINITIONSHAPE($,$,(#%d))" % body)


def box(x, y, z):
    profile = line("IFCRECTANGLEPROFILEDEF(.AREA.,$,#22,%.3f,%.3f)" % (x, y))
    return line("IFCEXTRUDEDAREASOLID(#%d,#11,#9,%.3f)" % (profile, z))


out.write("""ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');
FILE_NAME('large.ifc','2020-01-01T00:00:00',('a'),('b'),'c','d','e');
FILE_SCHEMA(('IFC2X3'));
ENDSEC;
DATA;
#1=IFCPERSON($,$,'a',$,$,$,$,$);
#2=IFCORGANIZATION($,'b',$,$,$);
#3=IFCPERSONANDORGANIZATION(#1,#2,$);
#4=IFCAPPLICATION(#2,'1','c','d');
#5=IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0);
#6=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);
#7=IFCUNITASSIGNMENT((#6));
#8=IFCCARTESIANPOINT((0.,0.,0.));
#9=IFCDIRECTION((0.,0.,1.));
#10=IFCDIRECTION((1.,0.,0.));
#11=IFCAXIS2PLACEMENT3D(#8,#9,#10);
#12=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#11,$);
#13=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',#5,'p',$,$,$,$,(#12),#7);
#20=IFCCARTESIANPOINT((0.,0.));
#21=IFCDIRECTION((1.,0.));
#22=IFCAXIS2PLACEMENT2D(#20,#21);
#30=IFCCOLOURRGB($,0.6,0.3,0.2);
#31=IFCSURFACESTYLERENDERING(#30,0.,$,$,$,$,$,$,.FLAT.);
#32=IFCSURFACESTYLE('brick',.BOTH.,(#31));
#33=IFCPRESENTATIONSTYLEASSIGNMENT((#32));
""")
up, xdir = 9, 10
ydir = line("IFCDIRECTION((0.,1.,0.))")
site = placement(None, 0, 0, 0)
building = line("IFCBUILDING('%s',#5,'b',$,$,#%d,$,$,.ELEMENT.,$,$,$)" % (guid(), site))
line("IFCRELAGGREGATES('%s',#5,$,$,#13,(#%d))" % (guid(), building))
# One column shape, a circle with a capital, mapped to every column.
circle = line("IFCCIRCLEPROFILEDEF(.AREA.,$,#22,150.)")
shaft = line("IFCEXTRUDEDAREASOLID(#%d,#11,#9,2800.)" % circle)
capital = box(500, 500, 3000)
body = line("IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#%d,#%d))" % (shaft, capital))
column_map = line("IFCREPRESENTATIONMAP(#11,#%d)" % body)
identity = line("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#8,$,$)")
all_storeys = []
for storey in range(storeys):
    z = 3500 * storey
    place = placement(site, 0, 0, z)
    level = line("IFCBUILDINGSTOREY('%s',#5,'Storey %d',$,$,#%d,$,$,.ELEMENT.,%.1f)" % (guid(), storey, place, z))
    all_storeys.append(level)
    elements = []
    for i in range(400):
        x, y = 6000 * (i % 20), 6000 * (i // 20)
        turned = i % 2 == 1
        at = placement(place, x, y, 0, (0, 1, 0) if turned else (1, 0, 0))
        length = 5000 + (i * 37 + storey * 11) % 700
        solid = box(length, 200 + 10 * (i % 7), 3000)
        line("IFCSTYLEDITEM(#%d,(#33),$)" % solid)
        wall = line("IFCWALLSTANDARDCASE('%s',#5,'Wall %d.%d',$,$,#%d,#%d,'W%d')" %
                    (guid(), storey, i, at, shape("SweptSolid", solid), i))
        hole_at = placement(at, (i % 5) * 300 - 600, 0, 900)
        hole = line("IFCOPENINGELEMENT('%s',#5,'o',$,$,#%d,#%d,$)" % (guid(), hole_at, shape("SweptSolid", box(1200, 1000, 1400))))
        line("IFCRELVOIDSELEMENT('%s',#5,$,$,#%d,#%d)" % (guid(), wall, hole))
        values = [line("IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F%d'),$)" % (30 * (1 + i % 3))),
                  line("IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.F.),$)"),
                  line("IFCPROPERTYSINGLEVALUE('Length',$,IFCLENGTHMEASURE(%.3f),$)" % length)]
        pset = line("IFCPROPERTYSET('%s',#5,'Pset_WallCommon',$,(%s))" % (guid(), ",".join("#%d" % v for v in values)))
        line("IFCRELDEFINESBYPROPERTIES('%s',#5,$,$,(#%d),#%d)" % (guid(), wall, pset))
        elements.append(wall)
    for i in range(200):
        at = placement(place, 6000 * (i % 20) + 3000, 12000 * (i // 20) + 3000, 0)
        item = line("IFCMAPPEDITEM(#%d,#%d)" % (column_map, identity))
        elements.append(line("IFCCOLUMN('%s',#5,'Column %d.%d',$,$,#%d,#%d,$)" %
                             (guid(), storey, i, at, shape("MappedRepresentation", item))))
    at = placement(place, 57000, 57000, -300)
    elements.append(line("IFCSLAB('%s',#5,'Slab %d',$,$,#%d,#%d,$,.FLOOR.)" %
                         (guid(), storey, at, shape("SweptSolid", box(126000, 126000, 300)))))
    line("IFCRELCONTAINEDINSPATIALSTRUCTURE('%s',#5,$,$,(%s),#%d)" %
         (guid(), ",".join("#%d" % e for e in elements), level))
line("IFCRELAGGREGATES('%s',#5,$,$,#%d,(%s))" % (guid(), building, ",".join("#%d" % s for s in all_storeys)))
out.write("ENDSEC;\nEND-ISO-10303-21;\n")
