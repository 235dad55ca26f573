# The header below <prefix>/include, two folders above this file.
if(NOT TARGET shade::shade)
    get_filename_component(shade_prefix "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
    add_library(shade::shade INTERFACE IMPORTED)
    set_target_properties(shade::shade PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${shade_prefix}/include")
    if(UNIX)
        set_property(TARGET shade::shade PROPERTY INTERFACE_LINK_LIBRARIES m)
    endif()
endif()
