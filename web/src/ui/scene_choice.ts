// Choosing another scene: from the menu, or a file that was dropped on the page.

import type { Session } from "../protocol/session";
import type { SceneMenu } from "./scene_menu";

export class SceneChoice {
  /** Sequence number of the choice under way; 0 where there is none. */
  private underWay = 0;

  constructor(
    private readonly session: Session,
    private readonly menu: SceneMenu,
    private readonly report: (message: string) => void,
  ) {}

  load(name: string): void {
    this.underWay = this.session.loadScene(name);
    if (this.underWay === 0) this.menu.revert();
  }

  /** `most` is the size of a message that the server takes, in bytes; it closes the connection over a larger one. */
  loadText(text: string, most: number): void {
    // A character takes three bytes at most.
    if (most > 0 && 3 * text.length + 64 > most) {
      this.report("This file is too large for a scene.");
      return;
    }
    this.underWay = this.session.loadSceneText(text);
  }

  /** A Done or an Error, of this or of anything else. */
  answered(sequence: number, refused: boolean): void {
    if (sequence === 0 || sequence !== this.underWay) return;
    this.underWay = 0;
    if (refused) this.menu.revert();
  }

  /** The connection is lost, and with it the answer. */
  forget(): void {
    if (this.underWay !== 0) this.menu.revert();
    this.underWay = 0;
  }
}
