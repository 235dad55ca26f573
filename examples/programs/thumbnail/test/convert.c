/* convert.c FROM FORMAT TO - a model into another format, by assimp, for formats.sh. */
#include <assimp/cexport.h>
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    const struct aiScene *scene =
        argc == 4 ? aiImportFile(argv[1], aiProcess_Triangulate | aiProcess_GenNormals |
                                              aiProcess_JoinIdenticalVertices)
                  : NULL;
    if (scene && aiExportScene(scene, argv[2], argv[3], 0) == aiReturn_SUCCESS) return 0;
    fprintf(stderr, "%s\n", aiGetErrorString());
    return 1;
}
