/** Numbers in a row: a typed array (not of BigInt) or a plain one. */
export type Numbers = ArrayLike<number>;
/** "#RRGGBB", "#RGB", a name of CSS or "steel" or "clay", or red, green and blue of a display, 0 .. 1. */
export type Color = string | Numbers;
/** A side, or azimuth and elevation in degrees. */
export type Viewpoint = "front" | "right" | "back" | "left" | "top" | "bottom" | "iso" | Numbers;

/** k_e, k_a, k_d, k_s and n of a surface, in linear light. */
export interface Material {
    /** default 0 */
    emission?: Numbers;
    /** default: diffuse */
    ambient?: Numbers;
    /** default 1 */
    diffuse?: Numbers;
    /** default 0 */
    specular?: Numbers;
    /** n >= 0; default 0 */
    shininess?: number;
}

/** How a texture goes on beyond its edges; default "repeat". */
export type Wrap = "repeat" | "clamp" | "mirror";

/** A picture to wrap around a mesh: 3 or 4 bytes a pixel, row by row from the top.  With squares texels are
    seen as such, in pictures of at most 512 x 512. */
export interface Texture { data: Numbers; width: number; height: number; wrap?: [Wrap, Wrap]; squares?: boolean; }

/** What a mesh is made of.  Arrays are copied. */
export interface MeshSource {
    /** x, y, z of each vertex; in double they may lie anywhere.  Triangles with NaN or infinity are left
        out, and told. */
    positions: Numbers;
    /** Three a triangle, counter-clockwise from outside; default 0, 1, 2, ... */
    /** In place of indices: rows of 3 corners, or of 4, which are cut in two. */
    faces?: readonly Numbers[];
    indices?: Numbers;
    /** "auto", rounded where faces meet at less than 40 degrees (beyond 200,000 triangles "flat"),
        "smooth", "flat", or x, y, z of each vertex, of any length. */
    normals?: "auto" | "smooth" | "flat" | Numbers;
    /** One colour; default "clay". */
    color?: Color;
    /** Red, green and blue of each vertex or each face: bytes, or numbers 0 .. 1 of a display. */
    colors?: Numbers;
    /** u, v of each vertex, with v upward as in OBJ files; needs a texture, a relief or a glow. */
    uv?: Numbers;
    texture?: Texture;
    /** A normal map, with green upward as in glTF, or a bump map, brighter where it is higher: which of them,
        its texels tell. */
    relief?: Texture;
    /** Of a normal map the factor of its slopes, of a bump map the height of white above black in the unit of
        positions; default 1. */
    strength?: number;
    /** The light that the surface sends by itself, whatever shines on it. */
    glow?: Texture;
    /** Red, green and blue by which the linear light of glow is multiplied; default 1, 1, 1. */
    glowFactor?: Numbers;
    /** One of PRESETS, or the numbers of a surface; default: a little gloss on the colour. */
    material?: string | Material;
    /** 4 x 4 by columns, takes the mesh to the world. */
    pose?: Numbers;
    /** Draws silhouettes, boundaries, and creases of 30 degrees and more; default false. */
    edges?: boolean;
    /** false leaves faces out that are seen from behind, which is faster; default true. */
    twoSided?: boolean;
    /** 0 .. 1, times the texture's alpha: how much of what lies behind is hidden; default 1. */
    opacity?: number;
    /** Whether alpha blends, which is drawn last and leaves depth and ids as they are; default: opacity is
        below 1. */
    blend?: boolean;
    /** Texels of less alpha are holes; default 0, none. */
    cutoff?: number;
    /** How much of what the studio's light shows in it has its colour, 0 .. 1; default 0. */
    metal?: number;
    /** How blurred that is, 0 .. 1; default 0: by the exponent of the material. */
    roughness?: number;
    /** Whether neither lamps nor shadows change its color: the diffuse one of the material, times texture and
        colors; default false. */
    unlit?: boolean;
}

/** A mesh that is prepared once and may be drawn many times. */
export class Mesh {
    constructor(source: MeshSource);
    /** Gives the memory back now, not when the mesh is garbage-collected. */
    free(): void;
}

/** Matrices of WebGL, 4 x 4 by columns.  view is a rotation and a translation. */
/** With a size it serves pictures of that size alone. */
export interface Camera { view: Numbers; projection: Numbers; size?: [number, number]; }

/** A lamp, in linear light. */
export interface Light {
    /** x, y, z, 1 of a point; x, y, z, 0 of the way toward a lamp at infinity. */
    position: Numbers;
    /** Stands for diffuse and specular; default 1, 1, 1. */
    color?: Numbers;
    diffuse?: Numbers;
    specular?: Numbers;
    /** default 0 */
    ambient?: Numbers;
    /** a, b, c of 1 / (a + b r + c r^2); default: no attenuation. */
    constant?: number;
    linear?: number;
    quadratic?: number;
    /** Where the lamp points; default 0, 0, 0: it is no spot. */
    spotDirection?: Numbers;
    spotExponent?: number;
    /** The cosine of the angle from the axis to the edge of the cone. */
    spotCosCutoff?: number;
}

/** Light of one's own, and the equation that surfaces answer with. */
export interface Lighting {
    lights?: readonly Light[];
    /** Global ambient light; default 0. */
    ambient?: Numbers;
    /** default "blinn-phong" */
    model?: "blinn-phong" | "phong" | "lambert" | "ambient" | "emissive" | "cool-to-warm";
    /** A sum of SHADE_FLAG_ numbers of shade.h, 0 .. 63; default 0. */
    flags?: number;
}

export interface Options {
    /** "quick", three lamps that stay with the camera; "studio", a large lamp and a sky that throw soft
        shadows, also on a ground below; or lamps of your own.  default "quick" */
    light?: "quick" | "studio" | Lighting;
    /** Another program's material for all meshes, with its model of light: elsewhere.vtk({ power: 30 }). */
    look?: string;
    /** Where it is seen from: a camera that is fitted to the meshes, or your own; default "iso". */
    view?: Viewpoint | Camera;
    /** [width, height], or one number for both, 1 .. 16384; default [640, 480]. */
    size?: number | Numbers;
    /** Samples along each edge of a pixel, 1 .. 8; default 3. */
    samples?: number;
    /** null is transparent; default "white". */
    background?: Color | null;
    /** Orthographic; default false. */
    ortho?: boolean;
    /** The axis that points up; default "z". */
    up?: "y" | "z";
    /** Fills depth and ids of the picture; default false. */
    depth?: boolean;
}

/** A picture: sRGB with straight alpha, from the top left on. */
export class Picture {
    readonly width: number;
    readonly height: number;
    /** R, G, B, A bytes: what ImageData takes. */
    readonly data: ReturnType<Uint8ClampedArrayConstructor["from"]>;
    /** Along the axis of view at the centre of each pixel; Infinity where there is nothing. */
    readonly depth: Float32Array | null;
    /** The number of the mesh at the centre of each pixel; -1 where there is none. */
    readonly ids: Int32Array | null;
    /** The bytes of a PNG file: what Blob and Response take. */
    png(): Promise<ReturnType<Uint8ArrayConstructor["from"]>>;
}

/** What is thrown for a bad argument; the message begins with its name. */
export class ShadeError extends TypeError {}

/** The names of the 24 classic materials. */
export const PRESETS: readonly string[];

/** Materials of other programs by their own names, as text for the option look:
    elsewhere.vtk({ specular: 0.5, power: 30 }).  What is left out has the program's default. */
export const elsewhere: { readonly [program: string]: (numbers?: { [name: string]: number | readonly number[] }) => string };
/** The programs of elsewhere, each with its numbers and their defaults. */
export const PROGRAMS: { readonly [program: string]: string };

/** Draws one mesh or several.  Throws ShadeError for a bad
    argument and RangeError where memory is not enough. */
export function render(meshes: Mesh | MeshSource | readonly (Mesh | MeshSource)[],
                       options?: Options): Picture;

/** The bytes of a PNG of 16-bit grey, as depth cameras' data sets have it: depth in whole units, of a millimetre where
    the scene's is a metre, at least 1, and 0 where there is nothing.  What lies beyond 65,535 units is refused. */
export function depthPng(depth: Numbers, width: number, height: number, unit?: number): Promise<ReturnType<Uint8ArrayConstructor["from"]>>;
/** Reads such bytes, of any PNG of one grey number a pixel: infinity where they have 0. */
export function readDepthPng(bytes: Uint8Array, unit?: number): Promise<{ width: number; height: number; depth: Float32Array }>;
/** The bytes of a PNG of 16-bit grey: numbers of objects, of a Picture or a Frame, each one higher, 0 where there is none;
    numbers above 65,534 are refused. */
export function idsPng(ids: Int32Array, width: number, height: number): Promise<ReturnType<Uint8ArrayConstructor["from"]>>;
/** Reads such bytes: -1 where they have 0. */
export function readIdsPng(bytes: Uint8Array): Promise<{ width: number; height: number; ids: Int32Array }>;

/** What a Renderer fills; null is left out. */
export interface Frame {
    /** R, G, B bytes (or R, G, B, A), row by row. */
    color: Uint8Array | null;
    /** Along the camera's axis, in the unit of the scene. */
    depth: Float32Array | null;
    /** Object and triangle of each pixel, -1 where there is nothing. */
    ids: Int32Array | null;
    /** Unit vectors in the world, zero where there is nothing. */
    normals: Float32Array | null;
}

/** A mesh of a Renderer, of which any number of objects are instances. */
export interface Shape { readonly mesh: number; readonly triangles: number; readonly textures: readonly number[]; }
/** color and alpha multiply those of the shape; the others take the place of what it has. */
export interface Looks {
    color?: Color; alpha?: number; specular?: number | Color; shininess?: number; emission?: number;
    texture?: number; repeat?: Numbers; two_sided?: boolean; casts_shadow?: boolean;
}
export type ShapeName = "plane" | "sphere" | "ellipsoid" | "capsule" | "cylinder" | "box";

/** A camera as WebGL has it: view from the world, projection to clip space, 16 numbers by columns each.  With a size
    it serves pictures of that size alone. */
export interface CameraMatrices extends Camera { view: Float64Array; projection: Float64Array; }

/** Cameras in double precision. */
export const Camera: {
    /** At eye, looking at target; fov is the vertical angle in degrees, aspect width by height. */
    lookAt(eye: Numbers, target: Numbers | undefined,
           options: { up?: Numbers; fov?: number; aspect: number; near?: number; far?: number }): CameraMatrices;
    /** Of OpenCV: K, 3 x 3 row by row, in pixels whose centres are whole numbers; extrinsics, 3 x 4 or 4 x 4 row by
        row, take the world to a camera that looks down +z with +y down. */
    opencv(K: Numbers, extrinsics: Numbers, size: number | [number, number],
           options?: { near?: number; far?: number }): CameraMatrices;
    /** Of a projection and the place of the camera in the world, both by columns. */
    opengl(projection: Numbers, pose: Numbers): CameraMatrices;
    /** The nearest one that sees all positions from a side. */
    fitted(positions: Numbers, options?: { view?: Viewpoint; size?: number | [number, number]; up?: "y" | "z";
                                           ortho?: boolean; fov?: number; margin?: number }): CameraMatrices;
};

/** An object of a Renderer, and its number wherever one is wanted but for ===, which needs number: every call that
    takes its number takes it. */
export interface Solid {
    readonly number: number;
    readonly renderer: Renderer;
    valueOf(): number;
    /** 4 x 4 by columns; a place of three numbers may be assigned as well. */
    get pose(): Float64Array;
    set pose(value: Numbers);
    color: Color;
    change(options: Looks & { size?: number | Numbers }): void;
    show(visible?: boolean): void;
    /** Its number is not given again. */
    remove(): void;
}

/** One scene and many cameras: colour, depth, ids and normals in one call, the bytes of the Python
    package's class of this name, whose names these are. */
export class Renderer {
    constructor(height: number, width: number, options?: { samples?: number; srgb?: boolean; tolerance?: number });
    readonly height: number;
    readonly width: number;
    /** A Mesh with its colour, pictures, transparency, holes and material; or fields as of MeshSource without
        these, of which uv needs a texture in add(). */
    mesh(source: Mesh | { positions: Numbers; indices?: Numbers; normals?: "auto" | "flat" | "smooth" | Numbers;
                          uv?: Numbers; colors?: Numbers }): Shape;
    /** Ground for add(): rows of heights along y, over x from -half[0] to half[0] and y from -half[1] to half[1]. */
    height_field(heights: Numbers, rows: number, columns: number, half: Numbers): Shape;
    /** For add(); with faces 6 a cube, one below the other, +x, -x, +y, -y, +z, -z as in OpenGL.  Mipmaps are made. */
    texture(picture: Texture & { faces?: 1 | 6 }): number;
    /** A texture of 2 x 2 squares, which repeats. */
    checker(one?: Color, other?: Color): number;
    /** Size: half the sides of a plane (none: endless) and box, a radius, radii, or radius and half the
        length along z; of a shape its scale. */
    add(shape: ShapeName | Shape, size?: number | Numbers, options?: Looks & { at?: Numbers; pose?: Numbers }): Solid;
    /** The numbers of all objects, in order. */
    readonly objects: number[];
    /** What add() gave, by its number, which ids hold. */
    object(number: number | Solid): Solid;
    /** What is not given stays; undefined is as if add() had not been given it. */
    change(number: number | Solid, options: Looks & { size?: number | Numbers }): void;
    /** 4 x 4 by columns, a rotation and a translation */
    pose(number: number | Solid, pose: Numbers): void;
    /** A matrix for each of numbers, or for all objects in order; nothing moves where one is refused. */
    poses(poses: readonly Numbers[], numbers?: readonly (number | Solid)[]): void;
    show(number: number | Solid, visible?: boolean): void;
    /** Gives a shape other vertices: positions alone, where options may have others of the rest, which stays without a
        word; or all, as mesh() takes it; or heights, as height_field() took them.  Its objects show it. */
    update(shape: Shape, source: Parameters<Renderer["mesh"]>[0] | Numbers,
           options?: { indices?: Numbers; normals?: "auto" | "flat" | "smooth" | Numbers; uv?: Numbers; colors?: Numbers }): void;
    /** Objects and a sky that have the texture show the other picture. */
    update_texture(number: number, picture: Texture & { faces?: 1 | 6 }): void;
    /** Takes away an object, whose number none is given again, or a shape that no object shows, with the textures that
        came with it. */
    remove(what: number | Solid | Shape): void;
    /** Of a texture that no object, shape or sky shows */
    remove_texture(number: number): void;
    /** Takes away all objects, shapes and textures; lamps and a background of one colour stay. */
    clear(): void;
    /** Up to 8 lamps.  shadow: those, directional or spots, that cast shadows. */
    light(lights: readonly Light[], ambient?: Numbers, shadow?: number | readonly number[]): void;
    background(color: Color): void;
    /** From the colour straight below to that straight above, +z */
    sky(low?: Color, high?: Color): void;
    /** A cube, whose +y is up (+z of the world), as in OpenGL */
    sky_texture(texture: number): void;
    /** New arrays for render(), or for so many pictures of render_batch() */
    frame(wanted?: { color?: boolean; depth?: boolean; ids?: boolean; normals?: boolean; pictures?: number }): Frame;
    render(camera: Camera, out?: Frame, options?: { solid?: boolean; empty_depth?: number }): Frame;
    /** A picture for each camera, one after the other in each array.  poses has for each picture a matrix of each
        object, in the order of their numbers; the objects stay where they were, and one camera then serves all. */
    render_batch(cameras: Camera | readonly Camera[], poses?: readonly (readonly Numbers[])[], out?: Frame,
                 options?: { solid?: boolean; empty_depth?: number }): Frame;
    free(): void;
}

/** MuJoCo's own Renderer without OpenGL, over the module of @mujoco/mujoco. */
export namespace mujoco {
    class Renderer {
        constructor(mj: unknown, model: unknown, height?: number, width?: number, max_geom?: number);
        readonly height: number;
        readonly width: number;
        readonly scene: unknown;
        update_scene(data: unknown, camera?: number | string | object, scene_option?: unknown): void;
        /** Colour, 3 bytes a pixel; or depth in metres; or pairs of object and type, as Python has them. */
        render<T extends Uint8Array | Float32Array | Int32Array>(out?: T): T;
        enable_depth_rendering(): void;
        disable_depth_rendering(): void;
        enable_segmentation_rendering(): void;
        disable_segmentation_rendering(): void;
        close(): void;
    }
}

/** Decodes the bytes of a picture in a model, of "image/png" or "image/jpeg", or null: it is left out.  Each is
    decoded once, where a face shows it: colours, reliefs, what shines, and metal and roughness of glTF. */
export type Decoder = (bytes: Uint8Array, mimeType: string | undefined) => Texture | null;

/** Hands over a file that lies beside a model, by the name that the model has for it; null: there is none. */
export type Beside = (name: string) => Uint8Array | null;

/** Reads OBJ, STL, PLY, OFF, glTF, GLB or 3MF: one mesh for each surface, as render takes them.  The bytes tell the
    format, where format does not.  STL and 3MF have +z up.  Materials of OBJ, buffers and pictures that are files of
    their own come by beside; what is missing, and what is not drawn, is a warning.  Rejects with a ShadeError for a
    file that is damaged or needs what is not read.  3MF needs DecompressionStream: Node.js from 18 on.  A color takes the
    place of all that the file says of its surfaces: materials, pictures, colours of vertices and faces. */
export function readModel(bytes: Uint8Array, options?: {
    format?: "obj" | "stl" | "ply" | "off" | "gltf" | "glb" | "3mf"; picture?: Decoder; beside?: Beside; color?: Color;
}): Promise<MeshSource[]>;

/** Reads glTF 2.0, GLB or JSON whose buffers are data URIs: one mesh for each surface, as render takes
    them, with +y up.  What is not drawn, pictures without a decoder among it, is a warning.  Throws
    ShadeError for a file that is damaged or needs what is not read. */
export function readGltf(bytes: Uint8Array, options?: { picture?: Decoder; color?: Color }): MeshSource[];

/** Reads 3MF: one mesh for each surface, with colours by vertex and +z up, of all that the file builds.
    Needs DecompressionStream: Node.js from 18 on.  Rejects with a ShadeError for a file that is damaged,
    unpacks to far more than it has, or needs what is not read.  The DOMParser that 1.2 wanted is not used. */
export function read3mf(bytes: Uint8Array,
                        options?: { picture?: Decoder; color?: Color; DOMParser?: unknown }): Promise<MeshSource[]>;
