#!/bin/sh
# Checks that there is a program to measure with, and writes the command that the suite calls.
program=$(command -v glintmark) || {
	echo "ERROR: glintmark is not in PATH; install its Debian package or run cmake --install"
	echo 1 > ~/install-exit-status
	exit 1
}
cat > glintmark <<EOT
#!/bin/sh
folder=\$(mktemp -d) || exit 1
"$program" bench --quiet -o "\$folder" "\$@" > "\$LOG_FILE" 2>&1
echo \$? > ~/test-exit-status
rm -rf "\$folder"
EOT
chmod +x glintmark
echo $? > ~/install-exit-status
