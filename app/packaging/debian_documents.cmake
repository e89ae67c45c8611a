# Adds to the package's folder what Debian asks for: copyright, changelog, lintian overrides, compressed manual pages.
set(share "${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share")
file(COPY "${CPACK_ERGODOME_DOCUMENTS}/copyright" DESTINATION "${share}/doc/ergodome")
configure_file("${CPACK_ERGODOME_DOCUMENTS}/lintian-overrides" "${share}/lintian/overrides/ergodome" COPYONLY)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${share}/doc/ergodome/changelog"
     "ergodome (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * See CHANGES.md in the sources.\n\n"
     " -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}\n")
file(GLOB pages "${share}/man/man1/*.1")
execute_process(COMMAND gzip -9nf ${pages} "${share}/doc/ergodome/changelog" COMMAND_ERROR_IS_FATAL ANY)
