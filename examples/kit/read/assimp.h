/* assimp.h - reads the formats of model_by_assimp (read.h) by assimp, as a model: its meshes where
   the tree of nodes puts them, their materials in the terms of shade.h, and embedded pictures. */
#ifndef MODEL_ASSIMP_H
#define MODEL_ASSIMP_H

#include "../image/pictures.h"
#include "gather.h"
#include <assimp/cimport.h>
#include <assimp/commonMetaData.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>

/* ---- meshes --------------------------------------------------------------------------------- */

typedef struct tree {
    const struct aiScene *scene;
    mesh_reader *reader;
    gather all;
    model *model; /* gets the names of nodes */
    unsigned depth;
} tree;

static shade_mat4 tree_matrix(const struct aiMatrix4x4 *a)
{
    shade_mat4 m = { { { a->a1, a->b1, a->c1, a->d1 },
                       { a->a2, a->b2, a->c2, a->d2 },
                       { a->a3, a->b3, a->c3, a->d3 },
                       { a->a4, a->b4, a->c4, a->d4 } } };
    return m;
}

/* The texture coordinates that the material of a mesh takes, or where there are no such ones the
   first; NULL: there are none */
static const struct aiVector3D *tree_texcoords(const tree *t, const struct aiMesh *mesh)
{
    const unsigned material = mesh->mMaterialIndex;
    unsigned set = 0;
    if (material < (unsigned)t->model->surface_count) set = t->model->surface[material].texcoords;
    if (set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !mesh->mTextureCoords[set]) set = 0;
    return mesh->mTextureCoords[set];
}

static int tree_vertex(tree *t, const struct aiMesh *mesh, unsigned i, shade_mat4 at,
                       shade_mat3 turn)
{
    const struct aiVector3D p = mesh->mVertices[i], *coords = tree_texcoords(t, mesh);
    const shade_vec3 P = shade_mat4_transform_point(at, shade_v3(p.x, p.y, p.z));
    gather_corner v = { .position = { (double)P.x, (double)P.y, (double)P.z },
                        .color = { 1, 1, 1 } };
    struct aiColor4D color = { 0, 0, 0, 0 };
    if (mesh->mNormals) {
        const struct aiVector3D n = mesh->mNormals[i];
        v.normal = shade_mat3_transform(turn, shade_v3(n.x, n.y, n.z));
    }
    if (mesh->mColors[0]) color = mesh->mColors[0][i];
    if (color.r + color.g + color.b + color.a > 0) { /* all 0: AMF has none there */
        v.color = shade_linear_from_srgb(shade_v3(color.r, color.g, color.b));
        t->all.colored = t->all.colors_kept = 1;
    }
    if (coords) {
        v.uv = shade_v2(coords[i].x, coords[i].y);
        t->all.textured = t->all.texcoords_kept = 1;
    }
    return gather_vertex(t->reader, &t->all, &v);
}

static int tree_mesh(tree *t, const struct aiMesh *mesh, shade_mat4 at)
{
    size_t first = t->all.positions.count / 3;
    shade_mat3 turn = shade_normal_matrix(at);
    int mirrored = shade_mat3_determinant(shade_mat3_from_mat4(at)) < 0;
    if (!mesh->mNumFaces) return 0;
    if (!(mesh->mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON))) {
        model_leave_out(t->model, t->reader->name, "its points and lines");
        return 0;
    }
    if (first + mesh->mNumVertices >= INT_MAX) return mesh_fail(t->reader, "too many vertices");
    if (faces_surface(&t->all.faces, (int)mesh->mMaterialIndex))
        return mesh_fail(t->reader, "out of memory");
    for (unsigned i = 0; i < mesh->mNumVertices; i++)
        if (tree_vertex(t, mesh, i, at, turn)) return 1;
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *f = &mesh->mFaces[i];
        if (faces_begin(&t->all.faces)) return mesh_fail(t->reader, "out of memory");
        for (unsigned k = 0; k < f->mNumIndices; k++) {
            unsigned corner = f->mIndices[mirrored ? f->mNumIndices - 1 - k : k];
            if (corner >= mesh->mNumVertices)
                return mesh_fail(t->reader, "a corner is out of range");
            if (faces_corner(&t->all.faces, (uint32_t)(first + corner)))
                return mesh_fail(t->reader, "out of memory");
        }
        if (faces_end(&t->all.faces)) return mesh_fail(t->reader, "out of memory");
        if (mesh_check_triangles(t->reader, t->all.faces.triangles)) return 1;
    }
    return 0;
}

static int tree_node(tree *t, const struct aiNode *node, shade_mat4 above)
{
    shade_mat4 at = shade_mat4_mul(above, tree_matrix(&node->mTransformation));
    int failed = 0, object;
    if (t->depth > 1000) return mesh_fail(t->reader, "nodes more than 1000 deep");
    if (t->depth == 2 && t->model->z_up) /* assimp 5 leaves out where AMF's instances are */
        model_leave_out(t->model, t->reader->name, "the places of its constellations");
    if (node->mNumMeshes) {
        object = model_add_object(t->model, node->mName.data, strlen(node->mName.data));
        if (object < 0 || faces_object(&t->all.faces, object))
            return mesh_fail(t->reader, "out of memory");
    }
    for (unsigned i = 0; i < node->mNumMeshes && !failed; i++)
        failed = tree_mesh(t, t->scene->mMeshes[node->mMeshes[i]], at);
    t->depth++;
    for (unsigned i = 0; i < node->mNumChildren && !failed; i++)
        failed = tree_node(t, node->mChildren[i], at);
    t->depth--;
    return failed;
}

/* ---- materials ------------------------------------------------------------------------------ */

/* A colour of a material, in linear light; returns 0 where the material has none. */
static int take_material_color(const struct aiMaterial *a, const char *key, shade_vec3 *out,
                               float *alpha)
{
    struct aiColor4D c = { 0, 0, 0, 1 };
    if (aiGetMaterialColor(a, key, 0, 0, &c) != aiReturn_SUCCESS) return 0;
    *out = shade_linear_from_srgb(shade_v3(c.r, c.g, c.b));
    if (alpha) *alpha = c.a;
    return 1;
}

static float take_material_float(const struct aiMaterial *a, const char *key, float none)
{
    float v = none;
    unsigned count = 1;
    if (aiGetMaterialFloatArray(a, key, 0, 0, &v, &count) != aiReturn_SUCCESS) return none;
    return v >= 0 ? v : none;
}

/* What a format calls its shininess, as an exponent.  3DS has percent, which lib3ds and the viewers
   built on it raise to 2^(10 p), at most 128; the others have exponents, up to 128 in AC3D. */
static float exponent_of(const char *name, float shininess)
{
    if (!(shininess > 0) || strcmp(model_kind_of(name).text, "3ds") != 0) return shininess;
    return fminf(128, exp2f(fminf(shininess, 100) / 10));
}

static void material_from_gloss(const struct aiMaterial *a, const char *name, shade_material *k)
{
    float strength = fminf(1, take_material_float(a, "$mat.shinpercent", 1));
    k->shininess = exponent_of(name, take_material_float(a, "$mat.shininess", 0));
    k->specular = shade_v3(0, 0, 0);
    take_material_color(a, "$clr.specular", &k->specular, NULL);
    k->specular = shade_scale(k->specular, strength);
    if (k->shininess < 1) k->specular = shade_v3(0, 0, 0);
}

/* 1: the material says only what materials without a colour are taken to say: white rough metal. */
static int says_nothing(const struct aiMaterial *a, const shade_material *k)
{
    const shade_vec3 c = k->diffuse, e = k->emission;
    return c.x >= 1 && c.y >= 1 && c.z >= 1 && e.x + e.y + e.z <= 0 &&
           take_material_float(a, "$mat.metallicFactor", 0) >= 1 &&
           take_material_float(a, "$mat.roughnessFactor", 0) >= 1;
}

/* The picture for k_d; physical: the material's base colour multiplies it.  Returns 1 where memory
   is out. */
static int map_from(model_surface *s, const struct aiMaterial *a, int physical)
{
    static const enum aiTextureType types[2] = { aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE };
    struct aiString text;
    for (int i = 0; i < 2 && !s->map; i++) {
        unsigned set = 0;
        if (aiGetMaterialTexture(a, types[i], 0, &text, NULL, &set, NULL, NULL, NULL, NULL) !=
            aiReturn_SUCCESS)
            continue;
        s->texcoords = set;
        s->map = model_text(text.data, strlen(text.data));
        s->set = 1;
        if (!s->map) return 1;
        if (!physical) model_show_map(s);
    }
    return 0;
}

/* The bump or normal map of a material, unless it has other texture coordinates than the colours.
   Returns 1 where memory is out. */
static int relief_from(model_surface *s, const struct aiMaterial *a)
{
    static const enum aiTextureType types[2] = { aiTextureType_NORMALS, aiTextureType_HEIGHT };
    model_relief *r = &s->relief;
    struct aiString text;
    for (int i = 0; i < 2 && !r->map; i++) {
        unsigned set = 0;
        if (aiGetMaterialTexture(a, types[i], 0, &text, NULL, &set, NULL, NULL, NULL, NULL) !=
            aiReturn_SUCCESS)
            continue;
        if (s->map && set != s->texcoords) continue;
        s->texcoords = set;
        r->map = model_text(text.data, strlen(text.data));
        if (!r->map) return 1;
        aiGetMaterialFloatArray(a, "$tex.scale", types[i], 0, &r->strength, NULL);
        r->strength = fabsf(r->strength);
    }
    return 0;
}

/* The picture of what shines, unless it has other texture coordinates than the others.  Returns 1
   where memory is out. */
static int glow_from(model_surface *s, const struct aiMaterial *a)
{
    static const enum aiTextureType types[2] = { aiTextureType_EMISSIVE,
                                                 aiTextureType_EMISSION_COLOR };
    struct aiString text;
    for (int i = 0; i < 2 && !s->glow_map; i++) {
        unsigned set = 0;
        if (aiGetMaterialTexture(a, types[i], 0, &text, NULL, &set, NULL, NULL, NULL, NULL) !=
            aiReturn_SUCCESS)
            continue;
        if ((s->map || s->relief.map) && set != s->texcoords) {
            s->material.emission = shade_v3(0, 0, 0);
            continue;
        }
        s->texcoords = set;
        s->set = 1;
        s->glow_map = model_text(text.data, strlen(text.data));
        if (!s->glow_map) return 1;
    }
    return 0;
}

static int surface_from(model_surface *s, const struct aiMaterial *a, const char *name)
{
    struct aiString text;
    shade_material *k = &s->material;
    float alpha = 1;
    int base = take_material_color(a, "$clr.base", &k->diffuse, &alpha);
    int named = aiGetMaterialString(a, "?mat.name", 0, 0, &text) == aiReturn_SUCCESS;
    s->set = !named || strcmp(text.data, AI_DEFAULT_MATERIAL_NAME) != 0;
    if (!base) take_material_color(a, "$clr.diffuse", &k->diffuse, NULL);
    k->ambient = k->diffuse;
    take_material_color(a, "$clr.emissive", &k->emission, NULL);
    if (!named && says_nothing(a, k)) s->set = 0;
    s->transparency = 1 - fminf(alpha, fminf(1, take_material_float(a, "$mat.opacity", 1)));
    if (base)
        model_rough(s, take_material_float(a, "$mat.metallicFactor", 0),
                    take_material_float(a, "$mat.roughnessFactor", 0.7f));
    else
        material_from_gloss(a, name, k);
    if (map_from(s, a, base) || relief_from(s, a) || glow_from(s, a)) return 1;
    model_glow(s, 0);
    return 0;
}

/* "*2" is the third embedded picture; others have the name of their former file. */
static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *name)
{
    for (unsigned i = 0; i < scene->mNumTextures; i++) {
        char number[16];
        snprintf(number, sizeof number, "*%u", i);
        if (!strcmp(name, number) || !strcmp(name, scene->mTextures[i]->mFilename.data))
            return scene->mTextures[i];
    }
    return NULL;
}

/* Embedded pictures: a file in memory where the height is 0, else texels of B, G, R, A.  Returns
   the number of the picture, or -1: out of memory. */
static int embedded_picture(model *m, const char *name, const struct aiTexture *t, int what)
{
    const int number = picture_add(m, name, what);
    model_picture *p;
    if (number < 0) return number;
    p = &m->picture[number];
    if (!t->mHeight) {
        const char *wrong = picture_decode(p, (const unsigned char *)t->pcData, t->mWidth);
        if (wrong) model_leave_out(m, name, wrong);
    } else if (t->mWidth && t->mWidth <= 16384 && t->mHeight <= 16384) {
        size_t n = (size_t)t->mWidth * t->mHeight;
        uint8_t *pixels = (uint8_t *)malloc(4 * n);
        for (size_t i = 0; pixels && i < n; i++) {
            pixels[4 * i] = t->pcData[i].r;
            pixels[4 * i + 1] = t->pcData[i].g;
            pixels[4 * i + 2] = t->pcData[i].b;
            pixels[4 * i + 3] = t->pcData[i].a;
        }
        if (pixels) picture_fill(p, pixels, (int)t->mWidth, (int)t->mHeight);
    }
    return number;
}

/* The number of a picture inside the file; -1: it is beside it, or there is none. */
static int tree_picture(tree *t, const char *name, int what)
{
    const int known = name ? picture_find(t->model, name, what) : -1;
    const struct aiTexture *embedded = name && known < 0 ? find_embedded(t->scene, name) : NULL;
    return embedded ? embedded_picture(t->model, name, embedded, what) : known;
}

static int tree_surfaces(tree *t, model *m)
{
    char name[32];
    for (unsigned i = 0; i < t->scene->mNumMaterials; i++) {
        model_surface *s;
        int n = snprintf(name, sizeof name, "%u", i);
        if (model_find_surface(m, name, (size_t)n, 1) != (int)i)
            return mesh_fail(t->reader, "out of memory, or more than 10000 materials");
        s = &m->surface[i];
        if (surface_from(s, t->scene->mMaterials[i], t->reader->name))
            return mesh_fail(t->reader, "out of memory");
        s->picture = tree_picture(t, s->map, 0);
        s->relief.picture = tree_picture(t, s->relief.map, 1);
        s->glow_picture = tree_picture(t, s->glow_map, 0);
    }
    return 0;
}

/* ---- the file ------------------------------------------------------------------------------- */

/* 1: since errno was 0, an allocation has failed.  Readers of assimp pass over that, and find an
   empty file or nothing. */
static int memory_ran_out(void) { return errno == ENOMEM; }

/* The model that was gathered */
static int tree_finish(tree *t, model *m)
{
    if (!t->all.faces.triangles && memory_ran_out()) return mesh_fail(t->reader, "out of memory");
    if (!t->all.faces.triangles && m->warning[0])
        return mesh_fail(t->reader, "points and lines alone are not drawn");
    return gather_finish(t->reader, &t->all, m);
}

/* 1: the format says which axis is up, once for all files or in each, and assimp turns it to y. */
static int tells_up(const char *kind)
{
    return !*kind || !strcmp(kind, "dae") || !strcmp(kind, "fbx");
}

/* The message of assimp in one line */
static int assimp_failed(mesh_reader *r)
{
    char text[200];
    size_t n = 0;
    if (memory_ran_out() || strstr(aiGetErrorString(), "bad_alloc"))
        return mesh_fail(r, "out of memory");
    for (const char *from = aiGetErrorString(); *from && n + 1 < sizeof text; from++)
        text[n++] = (char)(*from >= ' ' ? *from : ' ');
    text[n] = 0;
    return mesh_fail(r, "%s", n ? text : "assimp cannot read it");
}

/* 1: one of the words, with blanks between, is among those of model_by_assimp. */
static int assimp_promises(const char *words)
{
    for (const char *const *word = model_by_assimp; *word; word++) {
        const size_t n = strlen(*word);
        for (const char *at = words; (at = strstr(at, *word)) != NULL; at++)
            if ((at == words || at[-1] == ' ') && (!at[n] || at[n] == ' ')) return 1;
    }
    return 0;
}

/* The name of the format that assimp has found, where that is none of model_by_assimp; NULL: it is
   one of them */
static const char *assimp_other(const struct aiScene *scene)
{
    const struct aiMetadata *about = scene->mMetaData;
    const char *found = "a format without a name";
    for (unsigned i = 0; about && i < about->mNumProperties; i++)
        if (!strcmp(about->mKeys[i].data, AI_METADATA_SOURCE_FORMAT) &&
            about->mValues[i].mType == AI_AISTRING)
            found = ((const struct aiString *)about->mValues[i].mData)->data;
    for (size_t i = 0; i < aiGetImportFormatCount(); i++) {
        const struct aiImporterDesc *known = aiGetImportFormatDescription(i);
        if (!strcmp(known->mName, found) && assimp_promises(known->mFileExtensions)) return NULL;
    }
    return found;
}

/* Reads a file or, where bytes is not NULL, the size bytes there, which path names in messages. */
static int assimp_read(const char *path, const unsigned char *bytes, size_t size, model *m,
                       const model_request *q)
{
    const unsigned flags = aiProcess_SortByPType | aiProcess_FlipUVs | aiProcess_TransformUVCoords;
    static const model empty_model;
    static const tree empty_tree;
    mesh_reader r = mesh_about(path, q->error, q->error_size);
    model_kind kind = model_kind_of(path);
    tree t = empty_tree;
    int failed;
    *m = empty_model;
    r.most = q->most;
    errno = 0;
    if (!bytes)
        t.scene = aiImportFile(path, flags);
    else if (size <= UINT_MAX)
        t.scene = aiImportFileFromMemory((const char *)bytes, (unsigned)size, flags, kind.text);
    if (!t.scene) return assimp_failed(&r);
    if (assimp_other(t.scene)) {
        mesh_fail(&r, "it is of %s, which is not read", assimp_other(t.scene));
        aiReleaseImport(t.scene);
        return 1;
    }
    t.reader = &r;
    t.model = m;
    m->z_up = !strcmp(kind.text, "amf");
    m->up_told = m->z_up || tells_up(kind.text);
    failed = tree_surfaces(&t, m);
    if (!failed && t.scene->mRootNode)
        failed = tree_node(&t, t.scene->mRootNode, shade_mat4_identity());
    if (!failed) failed = tree_finish(&t, m);
    gather_free(&t.all);
    aiReleaseImport(t.scene);
    if (failed) model_free(m);
    return failed;
}
#endif
