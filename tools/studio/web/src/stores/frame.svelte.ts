// Which of the drawers beside the panels are open.
const narrow = matchMedia('(max-width: 1020px)');

class Frame {
  tree = $state(!narrow.matches);
  inspector = $state(!narrow.matches);
  get narrow(): boolean {
    return narrow.matches;
  }
}

export const frame = new Frame();
