-- The package for xmake's repository, packages/s/shade-h/xmake.lua.  The sum of an archive stands in
-- SHA256SUMS of its release; it follows the version in add_versions.
package("shade-h")
    set_kind("library", {headeronly = true})
    set_homepage("https://example.org/shade")
    set_description("Phong and Blinn-Phong light and an exact z-buffer rasterizer, one header")
    set_license("MIT OR Unlicense")

    add_urls("https://example.org/shade/releases/shade-$(version).tar.gz")
    add_versions("1.4.0", "0000000000000000000000000000000000000000000000000000000000000000")

    if is_plat("linux", "bsd") then
        add_syslinks("m")
    end

    on_install(function (package)
        os.cp("shade.h", package:installdir("include"))
    end)

    on_test(function (package)
        assert(package:has_cfuncs("shade_lit", {includes = "shade.h", configs = {languages = "c99"}}))
    end)
package_end()
