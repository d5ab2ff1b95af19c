# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# CPack packs in the order in which the folder lists its files; this packs them again by name, with one date
# (SOURCE_DATE_EPOCH, else that of the commit), so that the same commit gives the same bytes. Then writes SHA256SUMS.
set(date "$ENV{SOURCE_DATE_EPOCH}")
if(date STREQUAL "")
    execute_process(COMMAND git -C ${CPACK_PORTTOOL_SOURCE} log -1 --format=%ct OUTPUT_VARIABLE date
        OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
if(date STREQUAL "")
    set(date 0)
endif()
set(name ${CPACK_PACKAGE_FILE_NAME}.tar.gz)
execute_process(COMMAND tar -C ${CPACK_TEMPORARY_DIRECTORY}/.. --sort=name --mtime=@${date} --owner=0 --group=0
    --numeric-owner --mode=go-w -I "gzip -9n" -cf ${CPACK_PACKAGE_FILES} ${CPACK_PACKAGE_FILE_NAME}
    COMMAND_ERROR_IS_FATAL ANY)
file(SHA256 ${CPACK_PACKAGE_FILES} sum)
file(WRITE ${CPACK_PACKAGE_DIRECTORY}/SHA256SUMS "${sum}  ${name}\n")
