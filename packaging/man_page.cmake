# Writes OUTPUT, a manual of PROGRAM made from its --help and that of its commands; VERSION is its own.
function(help_of output)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env COLUMNS=72 ${PROGRAM} ${ARGN} --help
                  OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# As it stands, in a fixed font: backslashes, hyphens and lines that begin with a point are roff's.
function(verbatim output text)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  set(${output} "\n.nf\n${text}.fi\n" PARENT_SCOPE)
endfunction()

help_of(text)
string(REGEX MATCH "^[^\n]+" summary "${text}")
string(REGEX REPLACE "^glintmark (.*)\\.$" "\\1" summary "${summary}")
string(REGEX MATCH "\nSubcommands:\n(.*)\n\n" unused "${text}")
string(REGEX MATCHALL "\n  [a-z]+ " commands "\n${CMAKE_MATCH_1}")
verbatim(program "${text}")
set(page ".TH GLINTMARK 1 \"\" \"glintmark ${VERSION}\" \"User Commands\"
.SH NAME
glintmark \\- ${summary}
.SH SYNOPSIS
.B glintmark
[\\fIOPTIONS\\fR] \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]
.SH DESCRIPTION${program}")
string(APPEND page ".SH COMMANDS\n")
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  help_of(text ${command})
  verbatim(text "${text}")
  string(APPEND page ".SS ${command}${text}")
endforeach()
string(APPEND page ".SH ENVIRONMENT
.TP
.B GLINTMARK_KERNELS\\fR, \\fBGLINTMARK_SCENES\\fR, \\fBGLINTMARK_TABLES
Folders in place of those that are installed.
.TP
.B GLINTMARK_CACHE_DIR
Where compiled programs and fitted mixtures are kept.
.TP
.B GLINTMARK_DRIVER_S
Seconds after which a driver that gives no answer is taken to hang, in place of 600 (compilers: 3600).
")
file(WRITE ${OUTPUT} "${page}")
