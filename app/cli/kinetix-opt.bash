# Completion of kinetix-opt for bash. Files come where no option fits.
_kinetix_opt() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= k
  local common="--help --json --quiet --threads --seed --verbose"
  for ((k = 1; k < COMP_CWORD; ++k)); do
    case ${COMP_WORDS[k]} in
      verify | simulate | sweep | check | export | import | view) command=${COMP_WORDS[k]}; break ;;
    esac
  done
  case $before in
    --model) COMPREPLY=($(compgen -W "exact equilibrium rigid_body" -- "$word")); return ;;
    --format) COMPREPLY=($(compgen -W "stl 3mf step svg dxf mjcf glb scad all" -- "$word")); return ;;
    --process) COMPREPLY=($(compgen -W "polyjet fdm sla sls laser" -- "$word")); return ;;
    --unit) COMPREPLY=($(compgen -W "mm cm m in ft" -- "$word")); return ;;
    --material) COMPREPLY=($(compgen -W "tango tpu95a pp pa12 acrylic steel" -- "$word")); return ;;
    --slicer) COMPREPLY=($(compgen -W "prusa orca bambu cura" -- "$word")); return ;;
    --hinge) COMPREPLY=($(compgen -W "pin block film rod" -- "$word")); return ;;
    --state) COMPREPLY=($(compgen -W "flat folded" -- "$word")); return ;;
    -o) COMPREPLY=($(compgen -d -- "$word")); return ;;
    --threads | --seed | --time-limit | --monte-carlo | --fold-angle-deg | --theta-deg | --clearance | --cell-mm | --port | --soft-material | --tile-mm | --thickness-mm | --kerf-mm) return ;;
  esac
  local options
  case $command in
    verify) options="$common --process --hinge --bed --lock -o --open --fidelity" ;;
    simulate) options="$common --process --hinge --bed --lock -o --open --model --fold-angle-deg --drives --time-limit" ;;
    sweep) options="$common --process --hinge --bed --lock -o --open --resume --share" ;;
    check) options="$common --process --hinge --bed --lock --picture" ;;
    export) options="$common -o --format --process --hinge --clearance --cell-mm --bed --lock --loose-rods --round-caps --orient --slicer --slice --coupon --state" ;;
    import) options="$common -o --hard --soft --unit --soft-material --material --hinges --tile-mm --thickness-mm --kerf-mm" ;;
    view) options="$common --process --hinge --bed --lock --no-open --port" ;;
    *) options="$common --version --process --hinge --bed --lock -o --open --no-verify --time-limit --fidelity --monte-carlo" ;;
  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
    [[ -z $command ]] && COMPREPLY+=($(compgen -W "verify simulate sweep check export import view" -- "$word"))
  fi
}
complete -o filenames -F _kinetix_opt kinetix-opt
