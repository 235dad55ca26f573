# SHA512 0 makes vcpkg print the sum of what it fetched; it belongs here once it has been checked
# against SHA256SUMS of the release.
vcpkg_download_distfile(ARCHIVE
    URLS "https://example.org/shade/releases/shade-${VERSION}.tar.gz"
    FILENAME "shade-${VERSION}.tar.gz"
    SHA512 0
)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${ARCHIVE}")

file(INSTALL "${SOURCE_PATH}/shade.h" DESTINATION "${CURRENT_PACKAGES_DIR}/include")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
