/* unit.h - what the sections are written with. */
#ifndef UNIT_H
#define UNIT_H

#include "shade.h"
#include "test.h"
#include "oracle.h"
#include "canvas.h"
#include "faults.h"
#include "meshes.h"
#include "rows.h"
#include "vectors.h"
#include "samples.h"
#include "corners.h"
#include "maps.h"
#include "scattered.h"

#endif
