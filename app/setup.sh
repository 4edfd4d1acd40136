# shellcheck shell=bash
# What app/run and tests/run share: find and install missing packages, add the backports suite for Mesa, choose
# the Vulkan driver. Everything it says goes to stderr. Sourced.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

readonly kExitCouldNotWork=3
aptDir=${KILOLUX_APT_DIR:-/etc/apt} # a test points it elsewhere
osRelease=${KILOLUX_OS_RELEASE:-/etc/os-release}

say() { printf 'kilolux: %s\n' "$*" >&2; }

# listedPackages run|test: "package command" lines; test includes run.
listedPackages() {
    local who package command
    while read -r who package command; do
        if [[ $who == run || $who == "$1" ]]; then
            printf '%s %s\n' "$package" "$command"
        fi
    done < <(grep -vE '^[[:space:]]*(#|$)' "$root/app/packages.txt")
}

# missingPackages run|test: names, one a line. One call of dpkg-query, so that it costs nothing when all is there.
missingPackages() {
    local package command installed=" "
    local -a names
    mapfile -t names < <(listedPackages "$1" | cut -d ' ' -f 1)
    if command -v dpkg-query >/dev/null; then
        # Fails when any name is unknown; what it knows it prints all the same.
        installed=" $(dpkg-query -W -f '${Package}=${db:Status-Status} ' "${names[@]}" 2>/dev/null || true) "
    fi
    while read -r package command; do
        if [[ $installed == *" $package=installed "* ]]; then continue; fi
        if [[ -n $command ]] && command -v "$command" >/dev/null; then continue; fi
        printf '%s\n' "$package"
    done < <(listedPackages "$1")
}

isDebian12() {
    [[ -r $osRelease ]] && (
        # shellcheck disable=SC1090
        . "$osRelease"
        [[ ${ID:-} == debian && ${VERSION_ID:-} == 12 ]]
    )
}

# Sets `asRoot` to the words that make a command run as root; fails where that would ask for a password.
findRights() {
    asRoot=()
    if [[ $(id -u) == 0 ]]; then return 0; fi
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
        asRoot=(sudo -n)
        return 0
    fi
    return 1
}

apt() {
    "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 \
        -o Dpkg::Use-Pty=0 "$@" >&2 </dev/null
}

# ---------------------------------------------------------------------------------------------------------
# Mesa from bookworm-backports

# Prints the system's own Debian source with the suite replaced: its address, keys and options stay as they are.
backportsStanza() {
    local file
    for file in "$aptDir"/sources.list.d/*.sources; do
        [[ -e $file ]] || continue
        # One stanza a record, comments dropped; continued lines belong to the field above them.
        sed '/^#/d' "$file" | awk -v RS= -v FS='\n' '
            {
                own = 0; binary = 0; off = 0; text = ""; skip = 0
                for (i = 1; i <= NF; ++i) {
                    key = tolower($i); sub(/:.*/, "", key)
                    value = $i; sub(/^[^:]*:/, "", value)
                    if ($i ~ /^[ \t]/) { if (!skip) text = text $i "\n"; continue }
                    skip = key == "suites" || key == "components" || key == "types"
                    if (key == "suites" && (" " value " ") ~ /[ \t]bookworm[ \t]/) own = 1
                    if (key == "types" && (" " value " ") ~ /[ \t]deb[ \t]/) binary = 1
                    if (key == "enabled" && value ~ /no/) off = 1
                    if (!skip) text = text $i "\n"
                }
                if (own && binary && !off) {
                    printf "Types: deb\nSuites: bookworm-backports\nComponents: main\n%s", text
                    exit
                }
            }' >"$1"
        if [[ -s $1 ]]; then
            echo sources
            return 0
        fi
    done
    for file in "$aptDir"/sources.list "$aptDir"/sources.list.d/*.list; do
        [[ -e $file ]] || continue
        sed -nE 's/^deb[[:space:]]+((\[[^]]*\][[:space:]]+)?[^[:space:]]+)[[:space:]]+bookworm[[:space:]].*/deb \1 bookworm-backports main/p' \
            "$file" | head -n 1 >"$1"
        if [[ -s $1 ]]; then
            echo list
            return 0
        fi
    done
    return 1
}

hasBackports() {
    grep -qsE '^[^#]*[[:space:]]bookworm-backports([[:space:]]|$)' \
        "$aptDir"/sources.list "$aptDir"/sources.list.d/*.list "$aptDir"/sources.list.d/*.sources
}

# Adds the suite as an extra source and reads its package list; takes the source away again when it cannot be had.
addBackports() {
    local stanza kind added=""
    if ! hasBackports; then
        stanza=$(mktemp)
        kind=$(backportsStanza "$stanza") || {
            rm -f "$stanza"
            return 1
        }
        added=$aptDir/sources.list.d/kilolux-backports.$kind
        "${asRoot[@]}" install -m 644 "$stanza" "$added"
        rm -f "$stanza"
    fi
    if apt -o APT::Update::Error-Mode=any update; then return 0; fi
    if [[ -n $added ]]; then "${asRoot[@]}" rm -f "$added"; fi
    return 1
}

mesaVersion() { dpkg-query -W -f '${Version}' mesa-vulkan-drivers 2>/dev/null || true; }

# Lavapipe has ray query since Mesa 24.
mesaIsNew() {
    local version
    version=$(mesaVersion)
    [[ -n $version ]] && dpkg --compare-versions "$version" ge 24
}

installMesa() {
    local noBackports=$root/build/no-backports
    if mesaIsNew; then return 0; fi
    if [[ -n $(mesaVersion) && -e $noBackports ]]; then
        say "Mesa $(mesaVersion) without ray query; remove build/no-backports to try bookworm-backports again"
        return 0
    fi
    say "installing Mesa from bookworm-backports"
    if addBackports && apt install -y --no-install-recommends -t bookworm-backports mesa-vulkan-drivers; then
        return 0
    fi
    say "bookworm-backports cannot be had: going on with the stable Mesa, without ray query"
    mkdir -p "$root/build"
    touch "$noBackports"
    [[ -n $(mesaVersion) ]] || apt install -y --no-install-recommends mesa-vulkan-drivers
}

# ---------------------------------------------------------------------------------------------------------
# What the callers use

# setUpPackages run|test: installs what is missing, or says exactly what it is and stops.
setUpPackages() {
    local -a missing rest
    mapfile -t missing < <(missingPackages "$1")
    if [[ ${#missing[@]} == 0 ]] && { mesaIsNew || ! isDebian12 || ! findRights; }; then return 0; fi
    if [[ -n ${KILOLUX_SKIP_SETUP:-} ]]; then
        say "KILOLUX_SKIP_SETUP is set: nothing installed, though missing: ${missing[*]:-nothing}"
        return 0
    fi
    if ! isDebian12 || ! findRights; then
        say "error: these packages are missing (names of Debian 12): ${missing[*]}"
        if isDebian12; then
            say "install them as root (apt-get install ${missing[*]}), then start this again"
        else
            say "this is not Debian 12: install what they hold, then start this again with KILOLUX_SKIP_SETUP=1"
        fi
        exit "$kExitCouldNotWork"
    fi
    mapfile -t rest < <(printf '%s\n' "${missing[@]}" | grep -vx mesa-vulkan-drivers)
    if [[ ${#rest[@]} != 0 && -n ${rest[0]} ]]; then
        say "installing: ${rest[*]}"
        apt update || say "warning: the package lists could not all be read"
        apt install -y --no-install-recommends "${rest[@]}" || {
            say "error: apt could not install: ${rest[*]}"
            exit "$kExitCouldNotWork"
        }
    fi
    installMesa || {
        say "error: apt could not install: mesa-vulkan-drivers"
        exit "$kExitCouldNotWork"
    }
}

# Without a GPU only the software driver can work: the loader is spared the others and their complaints.
chooseDriver() {
    local device icd
    if [[ -n ${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-} ]]; then return 0; fi
    for device in /dev/dri/renderD* /dev/nvidia0; do
        if [[ -e $device ]]; then return 0; fi
    done
    for icd in /usr/share/vulkan/icd.d/lvp_icd*.json; do
        if [[ -e $icd ]]; then export VK_DRIVER_FILES=$icd; fi
    done
}

# Clones of one source at different places share the compiler cache.
shareCompilerCache() {
    export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root} CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR:-1}
}
