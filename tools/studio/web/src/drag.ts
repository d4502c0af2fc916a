// What is dragged between the tree, the diagram and the panels: an item by its id, or the sources of a plot.
const itemType = 'text/x-forage-item', sourcesType = 'text/x-forage-sources';

const carries = (e: DragEvent, type: string): boolean => e.dataTransfer?.types.includes(type) ?? false;
export const carriesItem = (e: DragEvent): boolean => carries(e, itemType);
export const carriesItemOrSources = (e: DragEvent): boolean => carriesItem(e) || carries(e, sourcesType);

/** Attributes of an element on which something is dropped that `carries` accepts. `take` gets the drop, `mark` whether something is held over it. */
export function dropTarget(carries: (e: DragEvent) => boolean, take: (e: DragEvent) => unknown, mark: (over: boolean) => void = () => {}) {
  function accept(e: DragEvent, act: () => unknown) {
    if (!carries(e)) return;
    e.preventDefault();
    e.stopPropagation();
    act();
  }
  return {
    'data-drops': '',
    ondragover: (e: DragEvent) => accept(e, () => mark(true)),
    ondragleave: () => mark(false),
    ondrop: (e: DragEvent) => (mark(false), accept(e, () => take(e))),
  };
}

export const dragItem = (e: DragEvent, id: string) => e.dataTransfer?.setData(itemType, id);
export const dragSources = (e: DragEvent, sources: string[]) => e.dataTransfer?.setData(sourcesType, JSON.stringify(sources));

/** The id of the dropped item; empty for anything else. */
export const droppedItem = (e: DragEvent): string => e.dataTransfer?.getData(itemType) ?? '';
/** The dropped sources; empty for anything else. */
export const droppedSources = (e: DragEvent): string[] => JSON.parse(e.dataTransfer?.getData(sourcesType) || '[]') as string[];
