// A static library of the header for programs in C and Zig.  This file and build.zig.zon belong at
// the top of the tree, beside shade.h:
//
//     const shade = b.dependency("shade-h", .{ .target = target, .optimize = optimize });
//     exe.linkLibrary(shade.artifact("shade"));      then @cImport(@cInclude("shade.h"))
//
// "zig build" installs the library and the header, "zig build ball" compiles and runs a program.
const std = @import("std");

pub fn build(b: *std.Build) void {
    const target = b.standardTargetOptions(.{});
    const optimize = b.standardOptimizeOption(.{});
    const flags = &.{ "-std=c99", "-O2", "-ffp-contract=off" };

    const lib = b.addStaticLibrary(.{ .name = "shade", .target = target, .optimize = optimize });
    const implementation = b.addWriteFiles().add("shade.c",
        \\#define SHADE_IMPLEMENTATION
        \\#include "shade.h"
        \\
    );
    lib.addIncludePath(.{ .path = "." });
    lib.addCSourceFile(.{ .file = implementation, .flags = flags });
    lib.linkLibC();
    lib.installHeader("shade.h", "shade.h");
    b.installArtifact(lib);

    const ball = b.addExecutable(.{ .name = "ball", .target = target, .optimize = optimize });
    ball.addCSourceFile(.{ .file = .{ .path = "examples/embed/meson/ball.c" }, .flags = flags });
    ball.linkLibrary(lib);
    b.step("ball", "Runs a program that is linked with the library")
        .dependOn(&b.addRunArtifact(ball).step);
}
